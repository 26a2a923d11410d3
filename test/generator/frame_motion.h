#pragma once

#include <Eigen/Core>
#include <functional>

namespace cosserat_cable::generator {

/// Motion of a section frame {a1, a2, a3} in the world frame.
struct FrameMotion {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();      ///< [m/s]
  Eigen::Vector3d w = Eigen::Vector3d::Zero();      ///< [rad/s]
  Eigen::Vector3d a = Eigen::Vector3d::Zero();      ///< [m/s^2]
  Eigen::Vector3d alpha = Eigen::Vector3d::Zero();  ///< [rad/s^2]
};
using FrameCurve = std::function<FrameMotion(double t)>;

}  // namespace cosserat_cable::generator
