#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace cosserat_cable::generator {

inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d S;
  S << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return S;
}

/// A rotation by its vector, and how its angular velocity follows from the vector's rate: with
/// b = (1 - cos x)/x^2 and c = (x - sin x)/x^3 the left Jacobian is I + b [psi] + c [psi]^2.
struct RotationVector {
  explicit RotationVector(const Eigen::Vector3d& psi) : psi(psi) {
    const double x2 = psi.squaredNorm();
    double a = 1.0 - x2 / 6.0 * (1.0 - x2 / 20.0);  // sin x/x
    b = 0.5 - x2 / 24.0 * (1.0 - x2 / 30.0);
    c = 1.0 / 6.0 - x2 / 120.0 * (1.0 - x2 / 42.0);
    b_slope = -1.0 / 12.0 + x2 / 180.0;  // db/dx over x
    c_slope = -1.0 / 60.0 + x2 / 1260.0;
    if (x2 > 1e-3) {  // below, the series is good to 1e-10
      const double x = std::sqrt(x2);
      a = std::sin(x) / x;
      b = (1.0 - std::cos(x)) / x2;
      c = (1.0 - a) / x2;
      b_slope = (a - 2.0 * b) / x2;
      c_slope = (b - 3.0 * c) / x2;
    }
    const Eigen::Matrix3d S = skew(psi);
    R = Eigen::Matrix3d::Identity() + a * S + b * S * S;
    J = Eigen::Matrix3d::Identity() + b * S + c * S * S;
  }
  Eigen::Vector3d velocity(const Eigen::Vector3d& rate) const { return J * rate; }
  Eigen::Vector3d acceleration(const Eigen::Vector3d& rate, const Eigen::Vector3d& second) const {
    const Eigen::Vector3d once = psi.cross(rate), twice = psi.cross(once);
    const double along = psi.dot(rate);
    return J * second + along * (b_slope * once + c_slope * twice) + c * rate.cross(once);
  }

  Eigen::Vector3d psi;
  Eigen::Matrix3d R, J;
  double b, c, b_slope, c_slope;
};

/// The vector of a rotation by less than half a turn.
inline Eigen::Vector3d rotationVectorOf(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

}  // namespace cosserat_cable::generator
