// How far an element of a cable may move towards a body before it is worth another look.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace cosserat_cable {

/// What was known of an element's distance from a body, and where its ends were then, in the body's
/// frame. A distance changes by no more than its point moves, and a point between two nodes moves
/// by no more than the farther-moving one.
struct ElementWatch {
  Eigen::Vector3d left_B = Eigen::Vector3d::Zero(), right_B = Eigen::Vector3d::Zero();  // [m]
  double distance = -std::numeric_limits<double>::infinity();  // a lower bound then [m]

  /// A lower bound of the distance [m] with the ends where they are now.
  double DistanceAt(const Eigen::Vector3d& a_B, const Eigen::Vector3d& b_B) const {
    const double square = std::max((a_B - left_B).squaredNorm(), (b_B - right_B).squaredNorm());
    return distance - std::sqrt(square);
  }
};

}  // namespace cosserat_cable
