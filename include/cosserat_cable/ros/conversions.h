// Between ROS messages and the core's types. Time is a count of nanoseconds wherever instants are
// compared or stepped: a double cannot hold today's epoch to better than 0.2 us.
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Transform.h>
#include <ros/time.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

inline std::int64_t ToNanoseconds(const ros::Time& time) {
  return static_cast<std::int64_t>(time.toNSec());
}
/// The nearest that messages can say: from 1970 to 2106.
inline ros::Time ToRosTime(std::int64_t nanoseconds) {
  static const auto kLast = static_cast<std::int64_t>(ros::TIME_MAX.toNSec());
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(std::clamp<std::int64_t>(nanoseconds, 0, kLast)));
  return time;
}

/// The pose that a transform message says, its quaternion normalised. False, and `pose` untouched,
/// where a number is not finite or the quaternion is farther than 1 % from unit length.
bool ToPose(const geometry_msgs::Transform& transform, Pose* pose);
geometry_msgs::Transform ToTransform(const Pose& pose);

inline geometry_msgs::Point ToPoint(const Eigen::Vector3d& p) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  point.z = p.z();
  return point;
}

/// Frame ids of old recordings begin with a slash; tf2's do not.
inline std::string WithoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace cosserat_cable
