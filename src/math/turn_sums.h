// Weighted sums of positions and of small rotations' logarithms: the derivatives of a pose at a
// knot.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "cosserat_cable/math/spline_weights.h"

namespace cosserat_cable {

/// What the weights are applied to, with each coordinate in a row of its own, for loops over four
/// at a time; what is not set is zero, and no turn.
struct WeightedPoses {
  static constexpr int kMax = SplineWeights::kMaxKnots;
  WeightedPoses() { w.fill(1); }
  void Set(int k, const Eigen::Vector3d& p, const Eigen::Quaterniond& turn);

  std::array<double, kMax> px{}, py{}, pz{};     // positions [m]
  std::array<double, kMax> w, qx{}, qy{}, qz{};  // turns
};

struct WeightedSums {
  Eigen::Vector3d d_position, dd_position;  ///< [m/s], [m/s^2]
  Eigen::Vector3d d_phi, dd_phi;            ///< of the turns' logarithms [rad/s], [rad/s^2]
  bool small = false;  ///< every turn is below kSmallTurn; else d_phi, dd_phi say nothing
};

/// [rad], up to which the sums of logarithms are exact to rounding.
constexpr double kSmallTurn = 1;

WeightedSums SumUp(const WeightedPoses& poses, const SplineWeights& weights, int count);

}  // namespace cosserat_cable
