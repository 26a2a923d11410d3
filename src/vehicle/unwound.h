// Rotations that go on beyond half a turn.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cosserat_cable {

/// The logarithm [rad] of the unit quaternion q that follows `previous`, whole turns included.
/// @pre less than half a turn apart
Eigen::Vector3d Unwound(const Eigen::Quaterniond& q, const Eigen::Vector3d& previous);

}  // namespace cosserat_cable
