// Second stage of a record: how a clamp moves otherwise than its motion file says.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cosserat_cable/cable/faults.h"
#include "cosserat_cable/math/pose_curve.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// The mean over time of a motion: of its position, and of its rotation as the one from which the
/// rotation vectors to all others have no mean.
Pose MeanPose(const ClampMotion& motion);

/// The poses with their displacements and rotation vectors from the mean times `factor`.
std::vector<Pose> Amplified(const ClampMotion& motion, double factor);

/// Angular frequency [rad/s] at which most of a motion's power is: the peak of its periodogram,
/// with rotations as seen 0.1 m away. 0 where nothing moves.
double DominantFrequency(const ClampMotion& motion);

/// A clamp on a bracket that gives way: a mass on a spring and a dashpot, whose other ends follow
/// the motion u of the file,
///
///     y'' + 2 zeta w (y' - u') + w^2 (y - u) = 0,   H = (w^2 + 2 zeta w s)/(s^2 + 2 zeta w s +
///     w^2),
///
/// in each component of the position, and of the rotation vector from the mean (less than half a
/// turn). At the motion's first instant the bracket moves along. Solved exactly for a u'' that is a
/// parabola over each step of a grid finer than the bracket's period and the file's samples;
/// between the grid's points C2.
class BracketPath {
 public:
  /// `path` at times [begin, end] [s], turning about `mean`; `sample` [s]: spacing of its samples.
  BracketPath(PoseCurve path, double shift, const Pose& mean, double sample, double begin,
              double end, const ClampMotionFault& fault);

  Motion At(double t) const;

 private:
  double begin_ = 0, h_ = 0;
  std::vector<Motion> points_;
};

}  // namespace cosserat_cable
