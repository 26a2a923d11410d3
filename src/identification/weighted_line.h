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
  /// Standard deviation of what the measurements scatter beyond their standard errors; estimated,
  /// so that it is above 0 in half of the cases without scatter. In `covariance`.
  double scatter = 0;
  bool scatters = false;  ///< whether chi_square says so, at 95 %
  /// Standard deviations of a 95 % interval: Student's, with the freedom that the estimated part
  /// of the variance leaves (Welch and Satterthwaite).
  double quantile = 0;

  double sd(Eigen::Index k) const;
};

/// y = X estimate, y with these variances. Where chi_square is above its expectation, as much
/// variance is added to each as brings it there (Mandel and Paule).
/// @pre X has full rank and at least as many rows as columns; variances are positive
WeightedLine FitWeightedLine(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                             const Eigen::VectorXd& variance);

/// Student's t below which 97.5 % lie. @pre freedom > 0
double StudentQuantile(double freedom);

/// Chi-square below which 95 % lie. @pre freedom > 0
double ChiSquareQuantile(int freedom);

}  // namespace cosserat_cable
