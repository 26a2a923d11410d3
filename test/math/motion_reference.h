// Analytic motions, and derivatives of a motion by differences of its poses alone.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

inline Eigen::Quaterniond AxisTurn(const Eigen::Vector3d& axis, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

/// Rotation from `a` to `b` divided by `step`, in the axes half-way: the mean angular velocity.
inline Eigen::Vector3d MeanAngularVelocity(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b,
                                           double step) {
  const Eigen::AngleAxisd turn(a.conjugate() * b);
  const double angle = turn.angle() > M_PI ? turn.angle() - 2 * M_PI : turn.angle();
  return turn.axis() * (angle / step);
}

/// The motion at `time` from the poses at time - step, time, time + step: central differences, with
/// errors of order step^2. `pose_at`: double -> Pose.
template <class PoseAt>
Motion DifferencedMotion(const PoseAt& pose_at, double time, double step) {
  const Pose before = pose_at(time - step), here = pose_at(time), after = pose_at(time + step);
  Motion motion;
  motion.X = here;
  motion.v = (after.p - before.p) / (2 * step);
  motion.a = (after.p - 2 * here.p + before.p) / (step * step);
  const Eigen::Vector3d omega_before = MeanAngularVelocity(before.q, here.q, step);
  const Eigen::Vector3d omega_after = MeanAngularVelocity(here.q, after.q, step);
  motion.omega = 0.5 * (omega_before + omega_after);
  motion.alpha = (omega_after - omega_before) / step;
  return motion;
}

}  // namespace cosserat_cable
