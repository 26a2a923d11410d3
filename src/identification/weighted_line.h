// Weighted linear least squares of a few repeated measurements, whose scatter may be larger than
// their standard errors say.
#pragma once

#include <Eigen/Core>

namespace cosserat_cable {

struct WeightedLine {
  Eigen::VectorXd estimate;
  Eigen::MatrixXd covariance;
  double chi_square = 0;  ///< with the standard errors as given
  int freedom = 0;        ///< measurements - parameters
  /// Standard deviation of what the measurements scatter beyond their standard errors; 0 where
  /// chi_square does not say so (at 95 %).
  double scatter = 0;
  double quantile = 0;  ///< standard deviations of a 95 % interval: Student's where they scatter

  double sd(Eigen::Index k) const;
};

/// y = X estimate, y with these variances. Where they scatter, as much variance is added to each as
/// brings chi_square to its expectation (Mandel and Paule).
/// @pre X has full rank and at least as many rows as columns; variances are positive
WeightedLine FitWeightedLine(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                             const Eigen::VectorXd& variance);

/// Student's t below which 97.5 % lie. @pre freedom > 0
double StudentQuantile(int freedom);

/// Chi-square below which 95 % lie. @pre freedom > 0
double ChiSquareQuantile(int freedom);

}  // namespace cosserat_cable
