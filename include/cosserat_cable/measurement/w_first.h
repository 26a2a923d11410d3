// Quaternions that were written w first, where qx, qy, qz, qw is expected.
#pragma once

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

/// The pose that was meant, where its quaternion qw, qx, qy, qz was read as qx, qy, qz, qw.
inline Pose MeantWithWFirst(const Pose& read) {
  Pose meant = read;
  meant.q = Eigen::Quaterniond(read.q.x(), read.q.y(), read.q.z(), read.q.w());
  return meant;
}

}  // namespace cosserat_cable
