// A twice continuously differentiable motion through timed samples of a pose.
//
// tf samples come at 50..500 Hz; a straight line between them has accelerations that shake a cable
// at the sample rate. Here each sample (knot) gets a velocity and an acceleration from an
// interpolating spline of degree 7 over the `kWindow` samples on either side of it, and between two knots
// runs the quintic Hermite polynomial of these values: C2 by construction, local, and independent
// of whether later samples are known already. Positions are interpolated componentwise; orientations on
// the rotation group, in the logarithm relative to the knot.
#pragma once

#include <cstddef>
#include <deque>

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

class PoseCurve {
 public:
  /// Samples on either side that a knot's derivatives depend on.
  static constexpr int kWindow = 10;

  /// `max_gap` [s]: two samples farther apart are not interpolated: the first pose is held, and the
  /// second is reached from rest to rest in the last `max_gap` before it.
  explicit PoseCurve(double max_gap = 0.25);

  /// Adds a sample. Returns false, and ignores it, unless `time` [s] is later than the last one by
  /// at least a microsecond and the pose is finite.
  bool Append(double time, const Pose& X_AB);

  /// No more samples will come: the curve is final up to its last sample.
  void Finish();

  bool empty() const;
  double begin_time() const;  ///< of the first sample kept [s]
  double end_time() const;    ///< of the last sample [s]

  /// The curve up to this time [s] is final: no sample that may still come changes it.
  /// Before the first sample of an empty curve: -infinity.
  double ready_until() const;

  /// Pose, velocity and acceleration at `time`; before the first and after the last sample their
  /// pose, at rest. @pre !empty()
  Motion Evaluate(double time) const;

  /// True where `time` lies between two samples farther apart than `max_gap`.
  bool InGap(double time) const;
  /// Number of gaps so far.
  std::size_t gap_count() const;

  /// Forgets samples that Evaluate(t >= time) does not need.
  void DropBefore(double time);

  // Data members: to be chosen by the implementation.
};

}  // namespace cosserat_cable
