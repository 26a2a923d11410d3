#include "cosserat_cable/ros/conversions.h"

#include <cmath>

namespace cosserat_cable {

bool ToPose(const geometry_msgs::Transform& transform, Pose* pose) {
  // Publishers round to float; a quaternion farther off than this is not a rounded rotation.
  constexpr double kUnitTolerance = 0.01;
  const Eigen::Vector3d p(transform.translation.x, transform.translation.y,
                          transform.translation.z);
  const Eigen::Quaterniond q(transform.rotation.w, transform.rotation.x, transform.rotation.y,
                             transform.rotation.z);
  const double norm = q.norm();
  if (!p.allFinite() || !std::isfinite(norm) || std::abs(norm - 1) > kUnitTolerance) return false;
  pose->p = p;
  pose->q = q.normalized();
  return true;
}

geometry_msgs::Transform ToTransform(const Pose& pose) {
  geometry_msgs::Transform transform;
  transform.translation.x = pose.p.x();
  transform.translation.y = pose.p.y();
  transform.translation.z = pose.p.z();
  transform.rotation.x = pose.q.x();
  transform.rotation.y = pose.q.y();
  transform.rotation.z = pose.q.z();
  transform.rotation.w = pose.q.w();
  return transform;
}

}  // namespace cosserat_cable
