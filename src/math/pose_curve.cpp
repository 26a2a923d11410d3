#include "cosserat_cable/math/pose_curve.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "cosserat_cable/math/motion_between.h"
#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/math/spline_weights.h"
#include "turn_sums.h"

namespace cosserat_cable {
namespace {

constexpr double kMinStep = 1e-6;       // [s]
constexpr double kMaxNormError = 0.01;  // of a quaternion: rounding in text files, not a mistake
constexpr double kMuchTurning = 1;      // [rad] across a window
constexpr std::size_t kPeriodsToSettle = 4;
constexpr std::size_t kPeriodsKept = 9;
constexpr int kMaxWindow = 2 * PoseCurve::kWindow + 1;
static_assert(kMaxWindow <= SplineWeights::kMaxKnots);

bool IsUsable(double time, const Pose& X) {
  return std::isfinite(time) && X.p.allFinite() && X.q.coeffs().allFinite() &&
         std::abs(X.q.norm() - 1) < kMaxNormError;
}

/// NaturalSplineWeights with a short memory: the joints of one message share their stamps, so the
/// curves of all of them ask for the same weights one after another.
const SplineWeights& RecalledWeights(const std::array<double, kMaxWindow>& times, int count,
                                     int knot, SplineDegree degree) {
  struct Memory {
    std::array<double, kMaxWindow> times{};
    int count = 0, knot = 0;
    SplineDegree degree = SplineDegree::kCubic;
    SplineWeights weights;
  };
  // One for each stream of messages that edges take turns with, such as joints and tf.
  thread_local std::array<Memory, 4> memory;
  thread_local std::size_t oldest = 0;
  for (const Memory& known : memory) {
    if (known.count == count && known.knot == knot && known.degree == degree &&
        std::equal(times.begin(), times.begin() + count, known.times.begin())) {
      return known.weights;
    }
  }
  Memory& fresh = memory[oldest];
  oldest = (oldest + 1) % memory.size();
  fresh = {times, count, knot, degree, NaturalSplineWeights(times.data(), count, knot, degree)};
  return fresh.weights;
}

/// The logarithm of q that is nearest to `previous`, so that a window may span more than a turn.
Eigen::Vector3d LogNear(const Eigen::Quaterniond& q, const Eigen::Vector3d& previous) {
  const Eigen::Vector3d phi = RotationLog(q);
  // All others are a full turn away from phi.
  if ((phi - previous).squaredNorm() <= M_PI * M_PI || phi.isZero(0)) return phi;
  const Eigen::Vector3d other = phi * (1 - 2 * M_PI / phi.norm());
  return (other - previous).squaredNorm() < (phi - previous).squaredNorm() ? other : phi;
}

// The sums over logarithms of turns which may each be more than half a turn away from the knot's,
// but not from the one before it on the way there.
void SumUpLargeTurns(const WeightedPoses& poses, const SplineWeights& weights, int centre,
                     int count, WeightedSums* sums) {
  sums->d_phi.setZero();
  sums->dd_phi.setZero();
  Eigen::Vector3d phi;
  const auto add = [&](int k) {
    phi = LogNear({poses.w[k], poses.qx[k], poses.qy[k], poses.qz[k]}, phi);
    sums->d_phi += weights.first[k] * phi;
    sums->dd_phi += weights.second[k] * phi;
  };
  phi.setZero();
  for (int k = centre + 1; k < count; ++k) add(k);
  phi.setZero();
  for (int k = centre - 1; k >= 0; --k) add(k);
}

}  // namespace

PoseCurve::PoseCurve(double max_gap) : max_gap_(max_gap) { assert(max_gap > 0); }

bool PoseCurve::Append(double time, const Pose& X_AB) {
  const double period = empty() ? 0 : time - knots_.back().time;
  const bool gap = !empty() && period > max_gap_;
  const bool too_close =
      !empty() && (period < kMinStep || (settled_ && period < kMinSpacing * median_period_));
  if (finished_ || !IsUsable(time, X_AB) || too_close) {
    ++ignored_count_;
    return false;
  }
  if (gap && !settled_) SettleStart();

  Knot knot;
  knot.time = time;
  knot.motion.X = {X_AB.p, X_AB.q.normalized()};
  // q and -q are one rotation; along the curve the sign shall not jump.
  Eigen::Quaterniond& q = knot.motion.X.q;
  if (!empty() && q.dot(knots_.back().motion.X.q) < 0) q.coeffs() *= -1;
  knot.gap_before = gap;
  knot.hole_before = gap || (settled_ && period > kHole * median_period_);
  const bool first = empty();
  const bool is_counted =
      !first && gap_rule_.IsGap(period, max_gap_, knots_.back().motion.X, knot.motion.X);
  knot.still_before = gap && !is_counted;
  knots_.push_back(knot);

  if (gap) {
    if (is_counted) ++gap_count_;
    start_ = size() - 1;
    periods_before_start_ = periods_.size();
  } else if (!first) {
    CountPeriod(period);
    if (!settled_ && periods_.size() >= kPeriodsToSettle) SettleStart();
  }
  FinalizeKnots();
  return true;
}

void PoseCurve::Finish() {
  if (!settled_) SettleStart();
  finished_ = true;
  FinalizeKnots();
}

double PoseCurve::begin_time() const {
  assert(!empty());
  return knots_.front().time;
}

double PoseCurve::end_time() const {
  assert(!empty());
  return knots_.back().time;
}

double PoseCurve::ready_until() const {
  return final_count_ > 0 ? knots_[final_count_ - 1].time
                          : -std::numeric_limits<double>::infinity();
}

void PoseCurve::CountPeriod(double period) {
  if (periods_.size() == kPeriodsKept) periods_.erase(periods_.begin());
  periods_.push_back(period);
  std::array<double, kPeriodsKept> sorted;
  std::copy(periods_.begin(), periods_.end(), sorted.begin());
  // The upper median: where two publishers interleave at a small offset, it is the long interval.
  const auto middle = sorted.begin() + periods_.size() / 2;
  std::nth_element(sorted.begin(), middle, sorted.begin() + periods_.size());
  median_period_ = *middle;
}

void PoseCurve::SettleStart() {
  for (int i = start_ + 1; i < size();) {
    const double period = knots_[i].time - knots_[i - 1].time;
    if (period < kMinSpacing * median_period_) {
      knots_.erase(knots_.begin() + i);
      ++ignored_count_;
    } else {
      knots_[i].hole_before = period > kHole * median_period_;
      ++i;
    }
  }
  periods_.resize(periods_before_start_);
  for (int i = start_ + 1; i < size(); ++i) CountPeriod(knots_[i].time - knots_[i - 1].time);
  settled_ = periods_.size() >= kPeriodsToSettle;
}

PoseCurve::Window PoseCurve::WindowOf(int knot) const {
  Window window;
  const bool last = knot + 1 == size();
  if (knots_[knot].gap_before || (!last && knots_[knot + 1].gap_before)) {
    return {knot, knot + 1, true, true};
  }
  window.beside_hole = knots_[knot].hole_before || (!last && knots_[knot + 1].hole_before);
  const auto ends_at = [&](const Knot& k) {
    return window.beside_hole ? k.gap_before : k.hole_before;
  };
  int begin = knot, back = knot;
  while (begin > 0 && knot - begin < kWindow && !ends_at(knots_[begin])) --begin;
  while (back + 1 < size() && back - knot < kWindow && !ends_at(knots_[back + 1])) ++back;
  window.begin = begin;
  window.end = back + 1;
  return window;
}

Motion PoseCurve::MotionAt(int knot, const Window& window) const {
  const Pose& here = knots_[knot].motion.X;
  Motion motion = Motion::Resting(here);
  const int count = window.end - window.begin;
  if (window.at_rest || count == 1) return motion;
  const int centre = knot - window.begin;
  SplineDegree degree = SplineDegree::kSeven;
  if (window.beside_hole || count < 4) {
    degree = SplineDegree::kCubic;
  } else if (count == kMaxWindow) {
    degree = SplineDegree::kNine;
  }

  std::array<double, kMaxWindow> times;
  for (int k = 0; k < count; ++k) times[k] = knots_[window.begin + k].time - knots_[knot].time;
  const SplineWeights& weights = RecalledWeights(times, count, centre, degree);

  // Orientations: R = R_knot exp(spin t) exp(psi), where the steady spin takes away the bulk of the
  // turning (a wheel's), so that psi stays small; it costs half of the time here, so only where it
  // is needed. At the knot psi = 0, and
  //   omega = spin + psi',  alpha = psi'' + spin x psi'.
  const Eigen::Quaterniond to_here = here.q.conjugate();
  const int before = std::max(centre - 1, 0), after = std::min(centre + 1, count - 1);
  const auto turn_to = [&](int k) {
    return RotationLog(to_here * knots_[window.begin + k].motion.X.q);
  };
  Eigen::Vector3d spin = (turn_to(after) - turn_to(before)) / (times[after] - times[before]);
  const bool spinning = spin.norm() * (times[count - 1] - times[0]) > kMuchTurning;
  if (!spinning) spin.setZero();

  WeightedPoses poses;
  for (int k = 0; k < count; ++k) {
    const Pose& X = knots_[window.begin + k].motion.X;
    const Eigen::Quaterniond turn = to_here * X.q;
    poses.Set(k, X.p - here.p, spinning ? RotationExp(-times[k] * spin) * turn : turn);
  }
  WeightedSums sums = SumUp(poses, weights, count);
  if (!sums.small) SumUpLargeTurns(poses, weights, centre, count, &sums);
  motion.v = sums.d_position;
  motion.a = sums.dd_position;
  motion.omega = spin + sums.d_phi;
  motion.alpha = sums.dd_phi + spin.cross(sums.d_phi);
  return motion;
}

// Whether no later sample can change the knot's window; see WindowOf.
bool PoseCurve::IsFinal(int knot) const {
  if (finished_ || knots_[knot].gap_before) return true;
  const bool last = knot + 1 == size();
  const bool beside_hole = knots_[knot].hole_before || (!last && knots_[knot + 1].hole_before);
  for (int k = knot + 1; k <= knot + kWindow; ++k) {
    if (k == size()) return false;
    if (beside_hole ? knots_[k].gap_before : knots_[k].hole_before) return true;
  }
  return true;
}

void PoseCurve::FinalizeKnots() {
  for (; final_count_ < size(); ++final_count_) {
    if (!IsFinal(final_count_)) return;
  }
}

// A window that is complete stays what it is: the derivatives can wait until they are needed, which
// those of many edges never are.
void PoseCurve::Know(int knot) {
  if (knots_[knot].known || knot >= final_count_) return;
  knots_[knot].motion = MotionAt(knot, WindowOf(knot));
  knots_[knot].known = true;
}

int PoseCurve::IntervalAt(double time) const {
  const auto later = std::upper_bound(knots_.begin(), knots_.end(), time,
                                      [](double t, const Knot& knot) { return t < knot.time; });
  return std::clamp(static_cast<int>(later - knots_.begin()) - 1, 0, size() - 2);
}

Motion PoseCurve::Evaluate(double time) const {
  assert(!empty() && std::isfinite(time));
  if (size() == 1 || time < begin_time()) return Motion::Resting(knots_.front().motion.X);
  if (time > end_time()) return Motion::Resting(knots_.back().motion.X);

  const int i = IntervalAt(time);
  double start = knots_[i].time;
  if (knots_[i + 1].gap_before) {
    start = knots_[i + 1].time - max_gap_;
    if (time <= start) return Motion::Resting(knots_[i].motion.X);
  }
  return PieceFrom(i, start).At(time - start);
}

MotionPiece PoseCurve::PieceFrom(int knot, double start) const {
  const auto motion = [this](int i) {
    return knots_[i].known ? knots_[i].motion : MotionAt(i, WindowOf(i));
  };
  return {motion(knot), motion(knot + 1), knots_[knot + 1].time - start};
}

Motion PoseCurve::Follow(double time) {
  if (!followed_ || time < followed_->begin || time >= followed_->end) {
    followed_.reset();
    if (time < begin_time() || time >= ready_until()) return Evaluate(time);
    const int i = IntervalAt(time);
    if (knots_[i + 1].gap_before) return Evaluate(time);
    Know(i);
    Know(i + 1);
    followed_ = FollowedPiece{knots_[i].time, knots_[i + 1].time, PieceFrom(i, knots_[i].time)};
  }
  return followed_->motion.At(time - followed_->begin);
}

bool PoseCurve::InGap(double time) const {
  if (size() < 2 || time <= begin_time() || time >= end_time()) return false;
  const int i = IntervalAt(time);
  return knots_[i + 1].gap_before && !knots_[i + 1].still_before && time > knots_[i].time;
}

void PoseCurve::DropBefore(double time) {
  if (size() < 2) return;
  // The knots that are not final yet need their windows, and so do those whose derivatives are not
  // known yet.
  const int drop = std::max(std::min(IntervalAt(time), final_count_) - kWindow, 0);
  knots_.erase(knots_.begin(), knots_.begin() + drop);
  final_count_ -= drop;
  start_ -= drop;
}

}  // namespace cosserat_cable
