// Between the kernel's plain types and Eigen's, which the public interfaces speak.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "cosserat_cable/math/small.h"

namespace cosserat_cable {

inline Vec3<double> ToSmall(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Quat<double> ToSmall(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
inline Eigen::Vector3d ToEigen(const Vec3<double>& v) { return {v.x, v.y, v.z}; }
inline Eigen::Quaterniond ToEigen(const Quat<double>& q) { return {q.w, q.x, q.y, q.z}; }

}  // namespace cosserat_cable
