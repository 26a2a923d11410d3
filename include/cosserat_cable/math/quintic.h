// The polynomial of degree five with given value, first and second derivative at both of its ends.
#pragma once

#include <Eigen/Core>

namespace cosserat_cable {

/// A vector and its first two time derivatives.
struct Jet {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< [1/s]
  Eigen::Vector3d second = Eigen::Vector3d::Zero();  ///< [1/s^2]
};

/// The quintic through `left` at time 0 and `right` at time `h` > 0 [s], at `time` in [0, h].
inline Jet EvaluateQuintic(const Jet& left, const Jet& right, double h, double time) {
  using Eigen::Vector3d;
  const double s = time / h;
  // The value is taken relative to `left`, so that a large offset costs no digits.
  const Vector3d d = right.value - left.value;
  const Vector3d v0 = left.first * h, v1 = right.first * h;
  const Vector3d a0 = left.second * (h * h), a1 = right.second * (h * h);
  const Vector3d c2 = 0.5 * a0;
  const Vector3d c3 = 10 * d - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1;
  const Vector3d c4 = -15 * d + 8 * v0 + 7 * v1 + 1.5 * a0 - a1;
  const Vector3d c5 = 6 * d - 3 * (v0 + v1) - 0.5 * (a0 - a1);
  Jet jet;
  jet.value = left.value + s * (v0 + s * (c2 + s * (c3 + s * (c4 + s * c5))));
  jet.first = (v0 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * (5 * c5))))) / h;
  jet.second = (2 * c2 + s * (6 * c3 + s * (12 * c4 + s * (20 * c5)))) / (h * h);
  return jet;
}

}  // namespace cosserat_cable
