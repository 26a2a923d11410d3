#include "motion_channel.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// A jump is a change of velocity that is taken back at once: what is around it is calm. Motion of a
// body that is sampled badly (three samples a period) still has neighbours half as large.
constexpr double kCalm = 1.0 / 3;
// Of a step of the motion around a gap.
constexpr double kHardlyFarther = 2;
// One sample is out of the ordinary where the second difference is so many times the usual one;
// encoder steps are twice the usual one at most.
constexpr double kOutOfOrdinary = 8;
// White noise of positions gives accelerations whose neighbours correlate by -2/3; a vibration at a
// third of the sampling rate by -1/2, one that is sampled ten times a period by +0.8.
constexpr double kAlternates = -0.55;
// Of white noise of positions, a linear prediction from the last four accelerations leaves
// (7 * 8) / (5 * 6) / 6 of the mean square; of a vibration, also one whose frequency changes, next
// to nothing.
constexpr int kPredictors = 4;
constexpr double kWhiteNoise = 0.31, kVibration = 0.1;
// What a vibration leaves of the recurrence a(k+1) + a(k-1) = c a(k), of the mean square.
constexpr double kRecurs = 0.05;
// Displacements may be off by one step of the grid each, and so their differences by two.
constexpr double kGridSteps = 2.1;
// A single event in a block says nothing of the other samples.
constexpr double kOneEvent = 0.4;  // of the sum of squares
// Stamps are the reason where samples counted out evenly are smoother by this (mean squares).
constexpr double kMuchSmoother = 0.1;
// A lost sample makes an interval of two periods.
constexpr double kLostSample = 1.6;
// Squares: a step has twice its square in changes of steps, smooth motion a small part of it.
constexpr double kJumpy = 0.7;

}  // namespace

void MotionChannel::Tally::Add(std::int64_t stamp, double new_size, double new_acceleration) {
  if (count == 0) first = stamp;
  if (count == 0 || new_size > size) {
    worst = stamp;
    size = new_size;
    acceleration = new_acceleration;
  }
  ++count;
}

void MotionChannel::Tally::Add(const Tally& other) {
  if (other.count == 0) return;
  first = count == 0 ? other.first : std::min(first, other.first);
  if (count == 0 || other.size > size) {
    worst = other.worst;
    size = other.size;
    acceleration = other.acceleration;
  }
  count += other.count;
}

void MotionChannel::Restart() {
  raw_ = Step();
  ring_size_ = 0;
  block_ = Block();
}

void MotionChannel::AddRaw(const Eigen::Vector3d& d, double h, std::int64_t stamp) {
  const bool together = raw_.h > 0 && raw_.h <= max_gap_ && h <= max_gap_;
  const Eigen::Vector3d v = d / h;
  if (together) {
    const double shorter = std::min(h, raw_.h);
    const double change = (v - raw_.v).norm() * shorter;
    const double usual = raw_count_ > 0 ? raw_sum_ / static_cast<double>(raw_count_) : 0;
    const double acceleration = change / (shorter * shorter);
    if (acceleration > limits_.acceleration && change > 2 * limits_.jump &&
        change > kOutOfOrdinary * usual) {
      accelerations_.Add(raw_.stamp, acceleration, acceleration);
    } else if (change > 0) {
      raw_sum_ += change;
      ++raw_count_;
    }
  }
  raw_.v = v;
  raw_.h = h;
  raw_.stamp = stamp;
}

void MotionChannel::Add(const Eigen::Vector3d& d, double h, std::int64_t stamp) {
  Step step;
  step.d = d;
  step.v = d / h;
  step.h = h;
  step.stamp = stamp;
  if (ring_size_ > 0) AddToBlock(ring_[ring_size_ - 1], step);
  if (ring_size_ == kRing) {
    std::copy(ring_.begin() + 1, ring_.end(), ring_.begin());
    --ring_size_;
  }
  ring_[ring_size_++] = step;
  if (ring_size_ == kRing) LookForJump();
}

// Whether the ring holds a vibration: with three samples in a period, one of them looks like a
// jump.
bool MotionChannel::IsVibration() const {
  std::array<Eigen::Vector3d, kRing - 1> a;
  for (int i = 0; i + 1 < kRing; ++i) a[i] = ring_[i + 1].v - ring_[i].v;
  double products = 0, squares = 0, left = 0, all = 0;
  for (int i = 1; i + 2 < kRing; ++i) {
    products += a[i].dot(a[i - 1] + a[i + 1]);
    squares += a[i].squaredNorm();
  }
  const double c = squares > 0 ? products / squares : 0;
  for (int i = 1; i + 2 < kRing; ++i) {
    left += (a[i - 1] + a[i + 1] - c * a[i]).squaredNorm();
    all += a[i - 1].squaredNorm() + a[i + 1].squaredNorm();
  }
  return left < kRecurs * all;
}

// Whether the step in the middle of the ring is one.
void MotionChannel::LookForJump() {
  constexpr int kMiddle = kRing / 2;
  // From the step `i` before or behind the middle one to the next.
  const auto change = [this](int i) {
    return Eigen::Vector3d(ring_[kMiddle + i + 1].v - ring_[kMiddle + i].v);
  };
  const Step& middle = ring_[kMiddle];
  // A pose that is hardly another one behind a gap did not jump, however fast the motion around is.
  if (middle.h > max_gap_ &&
      middle.d.norm() <
          kHardlyFarther * std::max(ring_[kMiddle - 1].d.norm(), ring_[kMiddle + 1].d.norm()))
    return;
  // Across a gap the motion is not known; above the vehicle, slow corrections are the rule.
  const double h = std::min(middle.h, max_gap_);
  const double excess = (change(-1) - change(0)).norm() / 2 * middle.h;
  const double acceleration = excess / (h * h);
  if (excess < limits_.jump || acceleration < limits_.jump_acceleration) return;
  const double around = std::max(change(-2).norm(), change(1).norm()) * middle.h;
  // There and on at the same pace as before: the two changes are opposite.
  const double taken_back = (change(-1) + change(0)).norm() * middle.h;
  if (around > kCalm * excess || taken_back > excess || IsVibration()) return;
  Tally& tally = excess < kGridSteps * grid_.Candidate() ? grid_jumps_ : jumps_;
  tally.Add(middle.stamp, excess, acceleration);
}

void MotionChannel::AddToBlock(const Step& before, const Step& step) {
  const Eigen::Vector3d change_of_step = step.d - before.d;
  squared_steps_ += step.d.squaredNorm();
  squared_changes_ += change_of_step.squaredNorm();
  if (step.d.norm() >= limits_.jump) largest_step_.Add(step.stamp, step.d.norm(), 0);
  const double h_mean = (step.h + before.h) / 2;
  const double h_capped = std::min(std::min(step.h, before.h), max_gap_);
  const double size = change_of_step.norm();
  largest_change_ = std::max(largest_change_, size);
  largest_acceleration_ = std::max(largest_acceleration_, size / (h_capped * h_capped));
  if (step.h > max_gap_ || before.h > max_gap_) {
    block_ = Block();
    return;
  }

  const Eigen::Vector3d a = (step.v - before.v) / h_mean;
  const double square = a.squaredNorm();
  if (block_.count == 0) block_.first = step.stamp;
  block_.squares += square;
  block_.largest = std::max(block_.largest, square);
  if (block_.count > 0) block_.products += a.dot(block_.accelerations[block_.count - 1]);
  const bool lost = std::max(step.h, before.h) > kLostSample * std::min(step.h, before.h) &&
                    change_of_step.norm() > step.d.norm() / 4;
  block_.by_index += lost ? square : change_of_step.squaredNorm() / std::pow(h_mean, 4);
  block_.accelerations[block_.count] = a;
  block_.intervals[block_.count] = step.h;
  if (++block_.count == kBlock) CloseBlock();
}

void MotionChannel::CloseBlock() {
  ++blocks_;
  const double rms = std::sqrt(block_.squares / kBlock);
  if (rms > limits_.noise) rough_.Add(block_.first, rms, std::sqrt(block_.largest));
  const bool one_event = block_.largest > kOneEvent * block_.squares;
  if (rms > limits_.lateness && block_.by_index < kMuchSmoother * block_.squares) {
    lateness_.Add(block_.first, rms, std::sqrt(block_.largest));
    worst_lateness_ = std::max(worst_lateness_, SpreadOfDelays());
  } else if (rms > limits_.noise && !one_event) {
    const double share = UnpredictedShare();
    const double noise = rms * std::sqrt(std::min(1.0, share / kWhiteNoise));
    if (share < kVibration) {
      double span = 0;
      for (const double h : block_.intervals) span += h;
      constexpr double kPairs = (kBlock - 1.0) / kBlock;
      const double cosine = std::clamp(block_.products / (kPairs * block_.squares), -1.0, 1.0);
      vibration_.Add(block_.first, rms, std::sqrt(block_.largest));
      vibration_frequency_ =
          std::min(vibration_frequency_, std::acos(cosine) / (2 * M_PI) * kBlock / span);
    } else if (noise > limits_.noise && block_.products < kAlternates * block_.squares) {
      noise_.Add(block_.first, noise, std::sqrt(block_.largest));
    }
  }
  block_ = Block();
}

// What a linear prediction from the accelerations before, and from those behind, leaves of the mean
// square.
double MotionChannel::UnpredictedShare() const {
  Eigen::Matrix<double, kPredictors, kPredictors> normal;
  Eigen::Matrix<double, kPredictors, 1> right;
  normal.setZero();
  right.setZero();
  double squares = 0;
  const auto& a = block_.accelerations;
  for (int k = 0; k + kPredictors < kBlock; ++k) {
    for (const bool forward : {true, false}) {
      const auto at = [&](int i) -> const Eigen::Vector3d& {
        return a[static_cast<std::size_t>(forward ? k + kPredictors - i : k + i)];
      };
      for (int i = 0; i < kPredictors; ++i) {
        right[i] += at(i + 1).dot(at(0));
        for (int j = 0; j < kPredictors; ++j) normal(i, j) += at(i + 1).dot(at(j + 1));
      }
      squares += at(0).squaredNorm();
    }
  }
  if (!(squares > 0)) return 0;
  // A vibration alone leaves the matrix singular.
  normal.diagonal().array() += 1e-9 * squares;
  const Eigen::Matrix<double, kPredictors, 1> c = normal.ldlt().solve(right);
  return std::max(0.0, 1 - c.dot(2 * right - normal * c) / squares);
}

// How far the stamps of the block are off a steady clock, from the earliest to the latest.
double MotionChannel::SpreadOfDelays() const {
  std::array<double, kBlock> times;
  double time = 0;
  for (int i = 0; i < kBlock; ++i) times[i] = time += block_.intervals[i];
  double mean = 0, slope = 0, squares = 0;
  constexpr double kMiddle = (kBlock - 1) / 2.0;
  for (const double t : times) mean += t / kBlock;
  for (int i = 0; i < kBlock; ++i) {
    slope += (i - kMiddle) * (times[i] - mean);
    squares += (i - kMiddle) * (i - kMiddle);
  }
  slope /= squares;
  double least = 0, most = 0;
  for (int i = 0; i < kBlock; ++i) {
    const double delay = times[i] - mean - slope * (i - kMiddle);
    least = std::min(least, delay);
    most = std::max(most, delay);
  }
  return most - least;
}

bool MotionChannel::MovesByJumps() const {
  const bool vibrates = 2 * vibration_.count > blocks_;
  return !vibrates && largest_change_ >= limits_.jump &&
         largest_acceleration_ >= limits_.jump_acceleration &&
         squared_changes_ > kJumpy * squared_steps_;
}

}  // namespace cosserat_cable
