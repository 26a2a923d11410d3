#include "outlier_judge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {
namespace {

// An outlier is off by so many times what the samples around it are off at most, and all samples on
// average. White noise reaches 2.5 times the largest of 16 once in ten million samples.
constexpr double kBeyondNeighbours = 3, kBeyondUsual = 8;
// The motion goes on as if nothing had happened: both parabolas meet within this share of the
// excursion, and their velocities differ by no more than this many excursions per interval. A blow
// of the same size changes the velocity by four.
constexpr double kMeets = 0.5, kSameVelocity = 1;
// Samples of one excursion, and both sides of a step, are off by the same.
constexpr double kAlike = 0.3;
// Stamps: intervals are even within this share, or not.
constexpr double kEven = 0.2;
// Of what a sample is off, its place on the path leaves no more than this.
constexpr double kOnPath = 0.25;
// Longer intervals, in the median of those around, are holes: what was between is not known.
constexpr double kHole = 2.75;
// Rotations between samples that are nearly half a turn apart say nothing.
constexpr double kLargestTurn = 2.5;  // [rad]
// A motor sets something in motion within one interval up to this speed [m/s], [rad/s]: then the
// first sample lies on the path of the others, nearer than at their speed.
constexpr double kStartsAtOnce[] = {2, 10};
constexpr double kOffPath = 0.2;  // of what it is off
// The first and last samples: so many are judged, by so many others.
constexpr int kLongestEnd = 3, kBehind = 8;
// An encoder's steps: so many, and the largest no more than this times the mean.
constexpr std::uint64_t kStepsOfEncoder = 8;
constexpr double kOneSize = 1.3;
// Rounding of poses [m], [rad].
constexpr double kRounding = 1e-7;

struct Extrapolated {
  Eigen::Vector3d p, v;
};

// The parabola through three places, at another time.
Extrapolated Parabola(const Eigen::Vector3d* p, const double* t, double at) {
  Extrapolated result{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double scale = 1 / ((t[i] - t[j]) * (t[i] - t[k]));
    result.p += scale * (at - t[j]) * (at - t[k]) * p[i];
    result.v += scale * (2 * at - t[j] - t[k]) * p[i];
  }
  return result;
}

}  // namespace

OutlierJudge::OutlierJudge(const OutlierLimits& translation, const OutlierLimits& rotation,
                           double max_gap)
    : limits_{translation, rotation}, max_gap_(max_gap) {}

bool OutlierJudge::Found::HasQuantum() const {
  return steps.count >= kStepsOfEncoder &&
         steps.size < kOneSize * steps.sum / static_cast<double>(steps.count);
}

void OutlierJudge::Restart() {
  JudgeRest();
  samples_.clear();
  next_ = kSide;
  begins_ = true;
}

void OutlierJudge::Add(std::int64_t stamp, const Pose& X_PC) {
  samples_.push_back({stamp, X_PC, {0, 0}});
  const int centre = static_cast<int>(samples_.size()) - 1 - kSide;
  if (centre >= kSide)
    for (int channel : {0, 1}) samples_[centre].off[channel] = Off(centre, channel);
  if (next_ + kLongest + kSide + kAround < static_cast<int>(samples_.size())) {
    JudgeBegin();
    const int before = next_;
    Judge(next_);
    for (int i = next_ - before; i > 0 && next_ > kAround + 2 * kSide; --i) Forget();
  }
}

// The neighbours of events do not count: theirs is set to zero by now.
void OutlierJudge::Forget() {
  for (int channel : {0, 1}) {
    const double off = samples_.front().off[channel];
    if (off < kRounding) continue;
    sum_[channel] += off;
    ++count_[channel];
  }
  samples_.pop_front();
  --next_;
}

void OutlierJudge::JudgeRest() {
  JudgeBegin();
  while (next_ + kSide < static_cast<int>(samples_.size())) Judge(next_);
}

void OutlierJudge::JudgeBegin() {
  if (!begins_ || static_cast<int>(samples_.size()) < kLongestEnd + kSide + kBehind) return;
  begins_ = false;
  for (const int channel : {0, 1}) {
    Event event;
    for (int n = kLongestEnd; n > 0 && event.kind == Event::Kind::kNone; --n)
      event = JudgeFirst(n, channel, false);
    if (event.kind == Event::Kind::kNone) continue;
    Note(event, 0, channel);
    // The step behind them is told by that.
    next_ = std::max(next_, event.length + 1);
    for (int i = 0; i < event.length + kSide; ++i) samples_[i].off = {0, 0};
  }
}

void OutlierJudge::Finish() {
  JudgeRest();
  const int size = static_cast<int>(samples_.size());
  if (size < kLongestEnd + kSide + kBehind) return;
  for (const int channel : {0, 1}) {
    Event event;
    for (int n = kLongestEnd; n > 0 && event.kind == Event::Kind::kNone; --n)
      event = JudgeFirst(n, channel, true);
    if (event.kind != Event::Kind::kNone) Note(event, size - event.length, channel);
  }
}

// Whether the first samples are off the parabola through the three next to them, by far more than
// the following ones are off theirs. `from_behind`: the last ones, and those before.
OutlierJudge::Event OutlierJudge::JudgeFirst(int length, int channel, bool from_behind) const {
  constexpr int kMost = kLongestEnd + kSide + kBehind;
  const int count = length + kSide + kBehind;
  const auto sample = [&](int i) -> const Sample& {
    return samples_[from_behind ? samples_.size() - 1 - static_cast<std::size_t>(i)
                                : static_cast<std::size_t>(i)];
  };
  const Sample& base = sample(length);
  Event event;
  std::array<Eigen::Vector3d, kMost> p;
  std::array<double, kMost> t = {};
  for (int i = 0; i < count; ++i) {
    t[i] = static_cast<double>(sample(i).stamp - base.stamp) * 1e-9;
    Eigen::Quaterniond turn = base.X.q.conjugate() * sample(i).X.q;
    if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
    p[i] = channel == 0 ? Eigen::Vector3d(sample(i).X.p - base.X.p) : RotationLog(turn);
    if (i < length || channel == 0) continue;
    if (p[i].norm() > kLargestTurn) return event;
  }
  const double h = std::abs(t[length] - t[length - 1]);
  double longest = 0;
  for (int i = 1; i < count; ++i) longest = std::max(longest, std::abs(t[i] - t[i - 1]));
  if (longest > std::min(max_gap_, kHole * h) || h > kHole * std::abs(t[count - 1]) / count)
    return event;
  const auto off = [&](int i, int from) {
    return Eigen::Vector3d(p[i] - Parabola(&p[from], &t[from], t[i]).p);
  };
  const Eigen::Vector3d apart = off(length - 1, length);
  const double size = apart.norm(), acceleration = size / (h * h);
  double usual = 0;
  for (int i = length; i < length + kBehind; ++i) usual = std::max(usual, off(i, i + 1).norm());
  if (!IsFarBeyond(size, usual, channel) || acceleration < limits_[channel].acceleration)
    return event;
  for (int i = 0; i + 1 < length; ++i)
    if (off(i, length).norm() < size / 2) return event;
  const Eigen::Vector3d v = Parabola(&p[length], &t[length], t[length]).v;
  const Eigen::Vector3d step = p[length - 1] / (t[length - 1] * v.norm());  // in that velocity
  const double along = step.dot(v.normalized());
  if (v.norm() < kStartsAtOnce[channel] && along > -kOffPath && along < 1 &&
      (step - along * v.normalized()).norm() * h * v.norm() < kOffPath * size)
    return event;
  event.kind = from_behind ? Event::Kind::kEnd : Event::Kind::kBegin;
  event.length = length;
  event.size = size;
  event.acceleration = acceleration;
  event.usual = usual;
  return event;
}

bool OutlierJudge::Look(int from, int count, int channel, Places* places, double* times) const {
  if (from < 0 || from + count > static_cast<int>(samples_.size())) return false;
  const Sample& first = samples_[from];
  std::array<double, 2 * kSide + kLongest> intervals;
  for (int i = 0; i < count; ++i) {
    const Sample& sample = samples_[from + i];
    times[i] = static_cast<double>(sample.stamp - first.stamp) * 1e-9;
    if (i > 0) intervals[i - 1] = times[i] - times[i - 1];
    if (channel == 0) {
      (*places)[i] = sample.X.p - first.X.p;
    } else {
      Eigen::Quaterniond turn = first.X.q.conjugate() * sample.X.q;
      if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
      (*places)[i] = RotationLog(turn);
      if ((*places)[i].norm() > kLargestTurn) return false;
    }
  }
  const auto end = intervals.begin() + (count - 1);
  const double longest = *std::max_element(intervals.begin(), end);
  const auto median = intervals.begin() + (count - 1) / 2;
  std::nth_element(intervals.begin(), median, end);
  return longest <= std::min(max_gap_, kHole * *median);
}

// How far a sample is off both parabolas, or these off each other.
double OutlierJudge::Off(int centre, int channel) const {
  Places p;
  double t[2 * kSide + 1];
  if (!Look(centre - kSide, 2 * kSide + 1, channel, &p, t)) return 0;
  const Extrapolated left = Parabola(&p[0], t, t[kSide]);
  const Extrapolated right = Parabola(&p[kSide + 1], t + kSide + 1, t[kSide]);
  return std::max((p[kSide] - (left.p + right.p) / 2).norm(), (left.p - right.p).norm() / 2);
}

// What the samples before `begin` and from `end` on are off at most; those whose own neighbours are
// in between do not count.
double OutlierJudge::Roughness(int begin, int end, int channel) const {
  double most = 0;
  const int size = static_cast<int>(samples_.size());
  for (int i = std::max(begin - kSide - kAround, 0); i < begin - kSide; ++i)
    most = std::max(most, samples_[i].off[channel]);
  for (int i = end + kSide; i < std::min(end + kSide + kAround, size); ++i)
    most = std::max(most, samples_[i].off[channel]);
  return most;
}

bool OutlierJudge::IsFarBeyond(double size, double usual, int channel) const {
  const double all = count_[channel] > 0 ? sum_[channel] / static_cast<double>(count_[channel]) : 0;
  return size > limits_[channel].size && size > kBeyondNeighbours * usual &&
         size > kBeyondUsual * all;
}

OutlierJudge::Event OutlierJudge::JudgeExcursion(int first, int length, int channel) const {
  Event event;
  Places p;
  double t[2 * kSide + kLongest];
  if (!Look(first - kSide, 2 * kSide + length, channel, &p, t)) return event;
  const Eigen::Vector3d* behind = &p[kSide + length];
  const double* t_behind = t + kSide + length;
  std::array<Eigen::Vector3d, kLongest> off;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double apart = 0, velocity = 0;
  for (int i = 0; i < length; ++i) {
    const Extrapolated left = Parabola(&p[0], t, t[kSide + i]);
    const Extrapolated right = Parabola(behind, t_behind, t[kSide + i]);
    off[i] = p[kSide + i] - (left.p + right.p) / 2;
    mean += off[i] / length;
    apart = std::max(apart, (left.p - right.p).norm());
    velocity = std::max(velocity, (left.v - right.v).norm());
  }
  const double size = mean.norm();
  const double usual = Roughness(first, first + length, channel);
  if (!IsFarBeyond(size, usual, channel)) return event;
  for (int i = 0; i < length; ++i)
    if ((off[i] - mean).norm() > kAlike * size) return event;
  const double h = std::min(t[kSide] - t[kSide - 1], t[kSide + length] - t[kSide + length - 1]);
  // Out and back within two intervals, or out within one.
  const double acceleration = (length == 1 ? 2 : 1) * size / (h * h);
  if (acceleration < limits_[channel].acceleration || apart > kMeets * size ||
      velocity * h > kSameVelocity * size)
    return event;
  event.kind = Event::Kind::kOutlier;
  event.length = length;
  event.size = size;
  event.acceleration = acceleration;
  event.usual = usual;
  return event;
}

// From the sample before `first` to it.
OutlierJudge::Event OutlierJudge::JudgeStep(int first, int channel) const {
  Event event;
  Places p;
  double t[2 * kSide];
  if (!Look(first - kSide, 2 * kSide, channel, &p, t)) return event;
  const double middle = (t[kSide - 1] + t[kSide]) / 2;
  const Extrapolated left = Parabola(&p[0], t, middle),
                     right = Parabola(&p[kSide], t + kSide, middle);
  const Eigen::Vector3d step = right.p - left.p;
  const double size = step.norm();
  const double usual = Roughness(first, first, channel);
  const double h = t[kSide] - t[kSide - 1];
  const double acceleration = size / (h * h);
  if (!IsFarBeyond(size, usual, channel) || acceleration < limits_[channel].acceleration ||
      (right.v - left.v).norm() * h > kAlike * size)
    return event;
  event.kind = Event::Kind::kStep;
  event.length = 1;
  event.size = size;
  event.acceleration = acceleration;
  event.usual = usual;
  return event;
}

// All other intervals around are even, and at an even time the sample is where it ought to be.
OutlierJudge::Event OutlierJudge::JudgeStamp(int at, int channel) const {
  Event event;
  Places p;
  double t[2 * kSide + 1];
  if (!Look(at - kSide, 2 * kSide + 1, channel, &p, t)) return event;
  std::vector<double> intervals;
  for (int i = 1; i < 2 * kSide + 1; ++i)
    if (i != kSide && i != kSide + 1) intervals.push_back(t[i] - t[i - 1]);
  std::sort(intervals.begin(), intervals.end());
  const double h = intervals[intervals.size() / 2];
  if (intervals.back() - intervals.front() > kEven * h) return event;
  const auto off = [&](double time) {
    const Extrapolated left = Parabola(&p[0], t, time);
    const Extrapolated right = Parabola(&p[kSide + 1], t + kSide + 1, time);
    return (p[kSide] - (left.p + right.p) / 2).norm();
  };
  const double size = off(t[kSide]);
  const double usual = Roughness(at, at + 1, channel);
  if (!IsFarBeyond(size, usual, channel)) return event;
  const double acceleration = 2 * size / (h * h);
  if (acceleration < limits_[channel].acceleration) return event;
  for (const double time :
       {(t[kSide - 1] + t[kSide + 1]) / 2, t[kSide - 1] + h, t[kSide + 1] - h}) {
    const double lateness = t[kSide] - time;
    if (std::abs(lateness) < kEven * h || off(time) > kOnPath * size) continue;
    if (event.kind != Event::Kind::kNone && std::abs(event.lateness) < std::abs(lateness)) continue;
    event.kind = Event::Kind::kStamp;
    event.length = 1;
    event.size = size;
    event.acceleration = acceleration;
    event.lateness = lateness;
    event.usual = usual;
  }
  return event;
}

void OutlierJudge::Judge(int at) {
  int length = 0;
  for (int channel : {0, 1}) {
    // Most samples are where they ought to be.
    double off = 0;
    for (int i = at; i < std::min<int>(at + kSide, static_cast<int>(samples_.size())); ++i)
      off = std::max(off, samples_[i].off[channel]);
    Event event;
    if (off > limits_[channel].size / 4) {
      event = JudgeStamp(at, channel);
      for (int n = 1; n <= kLongest && event.kind == Event::Kind::kNone; ++n)
        event = JudgeExcursion(at, n, channel);
      if (event.kind == Event::Kind::kNone) event = JudgeStep(at, channel);
    }
    if (event.kind == Event::Kind::kNone) continue;
    Note(event, at, channel);
    length = std::max(length, event.length);
  }
  // The neighbours of an event are off because of it.
  if (length > 0)
    for (int i = std::max(at - kSide, 0);
         i < std::min<int>(at + length + kSide, static_cast<int>(samples_.size())); ++i)
      samples_[i].off = {0, 0};
  next_ += length > 0 ? length : 1;
}

void OutlierJudge::Note(const Event& event, int at, int channel) {
  Found& found = found_[channel];
  Tally& tally = event.kind == Event::Kind::kOutlier ? found.outliers
                 : event.kind == Event::Kind::kStep  ? found.steps
                 : event.kind == Event::Kind::kBegin ? found.begins
                 : event.kind == Event::Kind::kEnd   ? found.ends
                                                     : found.stamps;
  const std::int64_t stamp = samples_[at].stamp;
  if (tally.count++ == 0) tally.first = stamp;
  tally.sum += event.size;
  if (event.size <= tally.size) return;
  tally.worst = stamp;
  tally.size = event.size;
  tally.acceleration = event.acceleration;
  tally.lateness = event.lateness;
  tally.usual = event.usual;
  tally.length = event.length;
}

}  // namespace cosserat_cable
