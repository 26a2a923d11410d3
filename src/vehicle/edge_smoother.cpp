#include "cosserat_cable/vehicle/edge_smoother.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/math/rotation.h"
#include "unwound.h"

namespace cosserat_cable {
namespace {

// (1 + u) exp(-u) = 1 / sqrt(2) at u = 1.0780: s = sqrt(2 u) / (2 pi cutoff).
constexpr double kWidth = 0.2337;  // of a period of the cutoff
// Beyond so many widths nothing is left that changes the gain by 0.1 %.
constexpr double kReach = 4.5;
// A steady clock is fitted over so long on either side [s]: hundreds of delays even out.
constexpr double kClockReach = 1;
// As EdgeJudge finds late stamps: samples so far apart [s], smoother by so much, and rough enough
// to matter [m/s^2].
constexpr double kBase = 0.008;
constexpr double kMuchSmoother = 0.1;
constexpr double kRough = 0.3;
constexpr std::uint64_t kEnough = 8;  // comparisons
constexpr double kLostSample = 1.6;   // of an interval
constexpr double kLever = 0.5;        // turns count with what they move at this distance [m]
constexpr double kLeastStep = 1e-6;   // between stamps [s]

Eigen::Vector3d LogFrom(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  return RotationLog(from.conjugate() * to);
}

}  // namespace

EdgeSmoother::EdgeSmoother(double cutoff, double max_gap)
    : width_(kWidth / cutoff), max_gap_(max_gap) {}

double EdgeSmoother::Latency(double cutoff) {
  return std::max(kReach * kWidth / cutoff, kClockReach);
}

void EdgeSmoother::Clear() { *this = EdgeSmoother(kWidth / width_, max_gap_); }

void EdgeSmoother::Add(std::int64_t stamp, const Pose& X, const Sink& sink) {
  if (!has_epoch_) {
    has_epoch_ = true;
    epoch_ = stamp;
  }
  Sample sample;
  sample.stamp = stamp;
  sample.time = static_cast<double>(stamp - epoch_) * 1e-9;
  sample.X = X;
  if (!samples_.empty()) {
    const double h = sample.time - samples_.back().time;
    sample.after_gap = h > max_gap_;
    if (!sample.after_gap) {
      period_sum_ += h;
      ++periods_;
    }
  }
  samples_.push_back(sample);
  Compare();
  Deliver(sink);
}

void EdgeSmoother::Finish(const Sink& sink) {
  finished_ = true;
  Deliver(sink);
  finished_ = false;
}

// Whether the newest samples are smoother by count than by their stamps.
void EdgeSmoother::Compare() {
  if (periods_ == 0 || restamps_) return;
  const double period = period_sum_ / static_cast<double>(periods_);
  const auto stride = static_cast<std::size_t>(std::max(1L, std::lround(kBase / period)));
  if (samples_.size() < 2 * stride + 1) return;
  const std::size_t last = samples_.size() - 1;
  const Sample& a = samples_[last - 2 * stride];
  const Sample& b = samples_[last - stride];
  const Sample& c = samples_[last];
  const double h1 = b.time - a.time, h2 = c.time - b.time;
  if (std::max(h1, h2) > max_gap_ || std::max(h1, h2) > kLostSample * std::min(h1, h2)) return;
  const Eigen::Vector3d d1 = b.X.p - a.X.p, d2 = c.X.p - b.X.p;
  const Eigen::Vector3d turn1 = LogFrom(a.X.q, b.X.q), turn2 = LogFrom(b.X.q, c.X.q);
  const double h = (h1 + h2) / 2;
  constexpr double kArea = kLever * kLever;
  by_stamp_ +=
      ((d2 / h2 - d1 / h1).squaredNorm() + kArea * (turn2 / h2 - turn1 / h1).squaredNorm()) /
      (h * h);
  by_count_ += ((d2 - d1).squaredNorm() + kArea * (turn2 - turn1).squaredNorm()) / std::pow(h, 4);
  ++compared_;
  restamps_ = compared_ >= kEnough &&
              by_stamp_ > kRough * kRough * static_cast<double>(compared_) &&
              by_count_ < kMuchSmoother * by_stamp_;
}

bool EdgeSmoother::IsReady(std::size_t i) const {
  if (finished_) return true;
  const double newest = samples_.back().time;
  // At the beginning it is not known yet whether stamps are late.
  if (newest < kClockReach) return false;
  if (newest - samples_[i].time >= std::max(kReach * width_, restamps_ ? kClockReach : 0))
    return true;
  for (std::size_t k = i + 1; k < samples_.size(); ++k)
    if (samples_[k].after_gap) return true;
  return false;
}

void EdgeSmoother::Deliver(const Sink& sink) {
  for (; next_ < samples_.size() && IsReady(next_); ++next_) {
    const Sample& sample = samples_[next_];
    const Fit fit = FitAt(next_);
    if (delivered_any_ && fit.time < delivered_ + kLeastStep) continue;
    delivered_any_ = true;
    delivered_ = fit.time;
    const std::int64_t stamp =
        restamps_ || fit.time != sample.time
            ? epoch_ + static_cast<std::int64_t>(std::llround(fit.time * 1e9))
            : sample.stamp;
    sink(stamp, fit.X);
  }
  const double reach = std::max(kReach * width_, kClockReach);
  const double needed = next_ < samples_.size() ? samples_[next_].time : samples_.back().time;
  while (next_ > 0 && samples_.front().time < needed - reach) {
    samples_.pop_front();
    --next_;
  }
}

// The samples [first, last] without a gap between them and i, at most `reach` [s] away from it.
std::pair<std::size_t, std::size_t> EdgeSmoother::Around(std::size_t i, double reach) const {
  std::size_t first = i, last = i;
  const double t = samples_[i].time;
  while (first > 0 && !samples_[first].after_gap && t - samples_[first - 1].time <= reach) --first;
  while (last + 1 < samples_.size() && !samples_[last + 1].after_gap &&
         samples_[last + 1].time - t <= reach)
    ++last;
  return {first, last};
}

// The steady clock around i: the stamps' straight line over the count of samples. Weights that fade
// away: samples that enter or leave the window must not jerk it.
EdgeSmoother::Clock EdgeSmoother::ClockAt(std::size_t i) const {
  const auto [first, last] = Around(i, kClockReach);
  const double period = period_sum_ / static_cast<double>(periods_);
  Clock clock;
  clock.first = first;
  const auto weight = [&](std::size_t k) {
    const double u = (samples_[k].time - samples_[i].time) / kClockReach;
    return (1 - u * u) * (1 - u * u);
  };
  double n = 0, sum_n = 0, sum_t = 0, sum = 0;
  for (std::size_t k = first; k <= last; ++k) {
    if (k > first)
      n += std::max(1.0, std::round((samples_[k].time - samples_[k - 1].time) / period));
    clock.counts.push_back(n);
    sum_n += weight(k) * n;
    sum_t += weight(k) * samples_[k].time;
    sum += weight(k);
  }
  const double mean_n = sum_n / sum, mean_t = sum_t / sum;
  double products = 0, squares = 0;
  for (std::size_t k = first; k <= last; ++k) {
    const double dn = clock.counts[k - first] - mean_n;
    products += weight(k) * dn * (samples_[k].time - mean_t);
    squares += weight(k) * dn * dn;
  }
  clock.period = squares > 0 ? products / squares : period;
  clock.start = mean_t - clock.period * mean_n;
  return clock;
}

EdgeSmoother::Fit EdgeSmoother::FitAt(std::size_t i) const {
  Clock clock;
  const bool steady = restamps_ && periods_ > 0;
  if (steady) clock = ClockAt(i);
  const auto time_of = [&](std::size_t k) {
    return steady ? clock.start + clock.period * clock.counts[k - clock.first] : samples_[k].time;
  };
  Fit fit{time_of(i), samples_[i].X};
  auto [first, last] = Around(i, kReach * width_);
  if (steady) {
    first = std::max(first, clock.first);
    last = std::min(last, clock.first + clock.counts.size() - 1);
  }
  if (last - first < 2) return fit;

  // Weighted sums of t^k, and the weights that give the fitted quadratic's value at t = 0.
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t k = first; k <= last; ++k) {
    const double t = (time_of(k) - fit.time) / width_;
    const Eigen::Vector3d powers(1, t, t * t);
    moments += std::exp(-t * t / 2) * powers * powers.transpose();
  }
  const Eigen::Vector3d at_zero = moments.ldlt().solve(Eigen::Vector3d::UnitX());
  if (!at_zero.allFinite()) return fit;

  const Pose& here = samples_[i].X;
  const Eigen::Quaterniond to_here = here.q.conjugate();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero(), phi;
  const auto add = [&](std::size_t k) {
    const double t = (time_of(k) - fit.time) / width_;
    const double weight = std::exp(-t * t / 2) * at_zero.dot(Eigen::Vector3d(1, t, t * t));
    phi = Unwound(to_here * samples_[k].X.q, phi);
    shift += weight * (samples_[k].X.p - here.p);
    turn += weight * phi;
  };
  phi.setZero();
  for (std::size_t k = i + 1; k <= last; ++k) add(k);
  phi.setZero();
  for (std::size_t k = i; k-- > first;) add(k);
  fit.X.p += shift;
  fit.X.q = (here.q * RotationExp(turn)).normalized();
  return fit;
}

}  // namespace cosserat_cable
