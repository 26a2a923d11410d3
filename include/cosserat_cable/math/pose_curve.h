// A twice continuously differentiable motion through timed samples of a pose.
//
// tf samples come at 50..500 Hz; a straight line between them has accelerations that shake a cable
// at the sample rate. Here each sample (knot) gets a velocity and an acceleration from a natural
// interpolating spline of degree 9 over the `kWindow` samples on either side of it, and between two
// knots runs the quintic Hermite polynomial of these values: C2 by construction, local, and
// independent of whether later samples are known already. Positions are interpolated componentwise;
// orientations on the rotation group: the knot's spline in the logarithm relative to a steady
// rotation through the knot, the pieces in the logarithm relative to their left knot.
//
// What it costs and gives: a knot is final `kWindow` samples later. A 30 Hz sine sampled at 100 Hz
// (3.3 samples a period) is met within 0.04 % of its amplitude, at stamps jittered by 10 % within
// 0.31 %; up to 20 Hz within 0.01 % and 0.03 %. (Degree 7: 0.3 % and 0.6 %; a cubic spline: 3.7 %.)
//
// Where samples are missing:
// - Near the first and last sample and beside a hole, windows are one-sided and of degree 7 (degree
//   9 would double the noise of the acceleration there). Cubic polynomials remain exact.
// - A hole is an interval of more than `kHole` running median periods. Windows end at it, and the
//   knots at its two sides take their derivatives from a cubic spline across it: noise of a sampled
//   acceleration, extrapolated over many periods, would throw the curve far off.
// - A gap is an interval of more than `max_gap`: the first pose is held, and the second is reached
//   from rest to rest in the last `max_gap` before it. The knots at its two sides are at rest.
//
// Orientations that follow each other must lie less than half a turn apart.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "cosserat_cable/math/gap_rule.h"
#include "cosserat_cable/math/motion_between.h"
#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

class PoseCurve {
 public:
  /// Samples on either side that a knot's derivatives depend on.
  static constexpr int kWindow = 10;
  /// A sample closer to the last one than this part of the median of the last periods is ignored:
  /// two stamps 0.2 ms apart in a 100 Hz stream would turn a rounding step into a jolt.
  static constexpr double kMinSpacing = 0.25;
  /// Longer intervals, in the same median, are holes. One lost sample is none, two in a row are.
  static constexpr double kHole = 2.75;

  /// `max_gap` [s]: two samples farther apart are not interpolated, see above.
  explicit PoseCurve(double max_gap = 0.25);

  /// Adds a sample; its quaternion is normalised. Returns false, and ignores it, unless `time` [s]
  /// is later than the last one by at least a microsecond and by `kMinSpacing` of the median
  /// period, the pose is finite, its quaternion's length within 1 % of one, and Finish() was not
  /// called. (The period is known after five samples: samples too close among these are taken out
  /// then, and counted.)
  bool Append(double time, const Pose& X_AB);

  /// No more samples will come: the curve is final up to its last sample.
  void Finish();

  bool empty() const { return knots_.empty(); }
  double begin_time() const;  ///< of the first sample kept [s]. @pre !empty()
  double end_time() const;    ///< of the last sample [s]. @pre !empty()

  /// The curve up to this time [s] is final: no sample that may still come changes it. -infinity
  /// until the first knot is final.
  double ready_until() const;

  /// Pose, velocity and acceleration at the finite `time`; before the first and after the last
  /// sample their pose, at rest. (The motion starts with the velocity that the samples show: at
  /// the very ends the velocity jumps.) Past ready_until(): as if no more samples came.
  /// @pre !empty()
  Motion Evaluate(double time) const;

  /// The same to the last bit; remembers the polynomials between two knots, which makes the next
  /// times there cheap.
  Motion Follow(double time);

  /// True where `time` lies between two samples farther apart than `max_gap`, unless the edge
  /// stands still there as always, see GapRule.
  bool InGap(double time) const;
  /// Number of gaps so far, dropped ones included.
  std::size_t gap_count() const { return gap_count_; }
  /// Number of samples ignored so far, for whichever reason.
  std::size_t ignored_count() const { return ignored_count_; }

  /// Forgets samples that Evaluate(t >= time) does not need.
  void DropBefore(double time);

 private:
  struct Knot {
    double time = 0;
    Motion motion;             ///< its pose; its derivatives once they were asked for
    bool known = false;        ///< whether they were, since the knot is final
    bool hole_before = false;  ///< also true for a gap
    bool gap_before = false;
    bool still_before = false;  ///< a gap across which nothing was to move
  };

  /// The knots [begin, end) on which a knot's derivatives depend.
  struct Window {
    int begin = 0, end = 0;
    bool at_rest = false;  ///< beside a gap
    bool beside_hole = false;
  };

  int size() const { return static_cast<int>(knots_.size()); }
  Window WindowOf(int knot) const;
  bool IsFinal(int knot) const;
  Motion MotionAt(int knot, const Window& window) const;
  void FinalizeKnots();
  void Know(int knot);
  void CountPeriod(double period);
  void SettleStart();
  int IntervalAt(double time) const;
  MotionPiece PieceFrom(int knot, double start) const;

  double max_gap_;
  std::deque<Knot> knots_;
  int final_count_ = 0;  ///< leading knots that are final
  bool finished_ = false;
  GapRule gap_rule_;
  std::size_t gap_count_ = 0;
  std::size_t ignored_count_ = 0;

  std::vector<double> periods_;  ///< the last few intervals that were no gaps [s]
  double median_period_ = 0;     ///< [s]
  bool settled_ = false;         ///< enough periods are known to judge an interval
  int start_ = 0;  ///< while not settled: the first knot, or the first after the last gap
  std::size_t periods_before_start_ = 0;

  /// Between two final knots, from the first up to before the second [s].
  struct FollowedPiece {
    double begin, end;
    MotionPiece motion;
  };
  std::optional<FollowedPiece> followed_;
};

}  // namespace cosserat_cable
