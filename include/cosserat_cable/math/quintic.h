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

/// The quintic through `left` at time 0 and `right` at `h` > 0 [s].
class Quintic {
 public:
  Quintic(const Jet& left, const Jet& right, double h) : h_(h), c0_(left.value) {
    // The value is taken relative to `left`, so that a large offset costs no digits.
    const Eigen::Vector3d d = right.value - left.value;
    const Eigen::Vector3d v0 = left.first * h, v1 = right.first * h;
    const Eigen::Vector3d a0 = left.second * (h * h), a1 = right.second * (h * h);
    c1_ = v0;
    c2_ = 0.5 * a0;
    c3_ = 10 * d - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1;
    c4_ = -15 * d + 8 * v0 + 7 * v1 + 1.5 * a0 - a1;
    c5_ = 6 * d - 3 * (v0 + v1) - 0.5 * (a0 - a1);
  }

  /// At `time` in [0, h] [s].
  Jet At(double time) const {
    const double s = time / h_;
    Jet jet;
    jet.value = c0_ + s * (c1_ + s * (c2_ + s * (c3_ + s * (c4_ + s * c5_))));
    jet.first = (c1_ + s * (2 * c2_ + s * (3 * c3_ + s * (4 * c4_ + s * (5 * c5_))))) / h_;
    jet.second = (2 * c2_ + s * (6 * c3_ + s * (12 * c4_ + s * (20 * c5_)))) / (h_ * h_);
    return jet;
  }

 private:
  double h_;
  Eigen::Vector3d c0_, c1_, c2_, c3_, c4_, c5_;  // of the powers of time / h
};

}  // namespace cosserat_cable
