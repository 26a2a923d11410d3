// Poses of frames, and how they move, in monogram notation: X_AB is the pose of frame B in frame A.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cosserat_cable {

/// Pose X_AB of a frame B in a frame A: position p_AB [m] in A's axes, rotation q_AB (unit).
struct Pose {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();

  /// X_AC = X_AB * X_BC.
  Pose operator*(const Pose& X_BC) const { return {p + q * X_BC.p, (q * X_BC.q).normalized()}; }
  /// A point given in B, as seen in A.
  Eigen::Vector3d operator*(const Eigen::Vector3d& p_B) const { return p + q * p_B; }
  Pose Inverse() const { return {q.conjugate() * -p, q.conjugate()}; }
};

/// How a frame B moves as seen from A: its pose and the first two time derivatives.
struct Motion {
  Pose X;                                             ///< X_AB
  Eigen::Vector3d v = Eigen::Vector3d::Zero();        ///< velocity of B's origin [m/s], in A
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();    ///< angular velocity [rad/s], in **B** (body)
  Eigen::Vector3d a = Eigen::Vector3d::Zero();        ///< acceleration of the origin [m/s^2], in A
  Eigen::Vector3d alpha = Eigen::Vector3d::Zero();    ///< d(omega)/dt [rad/s^2], in **B**

  static Motion Resting(const Pose& X_AB) {
    Motion motion;
    motion.X = X_AB;
    return motion;
  }

  /// Motion of C in A from that of B in A (this) and that of C in B.
  Motion operator*(const Motion& BC) const;
  /// The same for a C that is fixed to B.
  Motion operator*(const Pose& X_BC) const;
};

}  // namespace cosserat_cable
