#pragma once

#include <Eigen/Core>

namespace cosserat_cable::generator {

/// Gauss-Legendre quadrature on [-1, 1].
struct GaussRule {
  Eigen::VectorXd nodes;
  Eigen::VectorXd weights;
};

/// The rule with `count` nodes in ascending order, exact to degree 2 count - 1.
GaussRule gaussRule(int count);

/// P_0(x) .. P_{count-1}(x).
Eigen::RowVectorXd legendreValues(int count, double x);

/// The row that integrates, from -1 to x, the polynomial through values at the rule's nodes.
Eigen::RowVectorXd integralFromLeft(const GaussRule& rule, double x);

}  // namespace cosserat_cable::generator
