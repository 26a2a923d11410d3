#include "legendre.h"

#include <cmath>

namespace cosserat_cable::generator {

GaussRule gaussRule(int count) {
  const double kPi = std::acos(-1.0);
  GaussRule rule{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(kPi * (i + 0.75) / (count + 0.5));
    double slope = 1.0;
    // Newton from Tricomi's estimate: quadratic, so the fifth correction is below rounding.
    for (int iteration = 0; iteration < 6; ++iteration) {
      const Eigen::RowVectorXd p = legendreValues(count + 1, x);
      slope = count * (x * p[count] - p[count - 1]) / (x * x - 1.0);
      x -= p[count] / slope;
    }
    rule.nodes[i] = x;
    rule.weights[i] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

Eigen::RowVectorXd legendreValues(int count, double x) {
  Eigen::RowVectorXd p(count);
  p[0] = 1.0;
  if (count > 1) p[1] = x;
  for (int n = 1; n + 1 < count; ++n) {
    p[n + 1] = ((2.0 * n + 1.0) * x * p[n] - n * p[n - 1]) / (n + 1.0);
  }
  return p;
}

Eigen::RowVectorXd integralFromLeft(const GaussRule& rule, double x) {
  const int count = static_cast<int>(rule.nodes.size());
  // Coefficient k of the polynomial is (2k+1)/2 sum_i w_i P_k(x_i) f_i, and the integral of P_k
  // from -1 is (P_{k+1} - P_{k-1})/(2k+1).
  const Eigen::RowVectorXd p = legendreValues(count + 1, x);
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(count);
  for (int i = 0; i < count; ++i) {
    const Eigen::RowVectorXd at_node = legendreValues(count, rule.nodes[i]);
    double sum = 0.5 * (x + 1.0);
    for (int k = 1; k < count; ++k) sum += 0.5 * at_node[k] * (p[k + 1] - p[k - 1]);
    row[i] = rule.weights[i] * sum;
  }
  return row;
}

}  // namespace cosserat_cable::generator
