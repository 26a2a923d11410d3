// Lowest modes without damping.
#pragma once

#include <Eigen/Core>

#include "linearised_rod.h"

namespace cosserat_cable::rod {

struct UndampedModes {
  Eigen::VectorXd w_squared;  ///< ascending [1/s^2]; negative: the equilibrium is unstable
  Eigen::MatrixXd shapes;     ///< columns, orthonormal in M
};

/// The lowest `count` solutions of K(0) x = w^2 M x, or as many as there are; the first `accurate`
/// to rounding, the rest to be a basis. `scale`: a small w^2 [1/s^2], far below that of bending.
/// Subspace iteration, O(elements) each.
/// @throws std::runtime_error where it does not converge
UndampedModes FindUndampedModes(const LinearisedRod& rod, int count, int accurate, double scale);

}  // namespace cosserat_cable::rod
