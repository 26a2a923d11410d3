#include "unwound.h"

#include <cmath>

#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {

Eigen::Vector3d Unwound(const Eigen::Quaterniond& q, const Eigen::Vector3d& previous) {
  const Eigen::Vector3d phi = RotationLog(q);
  const double before = previous.norm();
  if (before < M_PI / 2) return phi;
  // Near whole turns q alone does not know its axis.
  constexpr double kAxisUnknown = 0.3;
  const double angle = phi.norm();
  const Eigen::Vector3d axis =
      angle > kAxisUnknown ? Eigen::Vector3d(phi / angle) : Eigen::Vector3d(previous / before);
  const double turns = std::round((previous - phi).dot(axis) / (2 * M_PI));
  return phi + 2 * M_PI * turns * axis;
}

}  // namespace cosserat_cable
