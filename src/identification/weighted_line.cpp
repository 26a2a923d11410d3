#include "weighted_line.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNormal975 = 1.959963984540054, kNormal95 = 1.6448536269514722;
// Student's quantile is within 0.1 % of the normal one beyond.
constexpr double kNormalFrom = 1000;
constexpr int kHalvings = 100;

struct Solution {
  Eigen::VectorXd estimate;
  Eigen::MatrixXd covariance;
  double chi_square;
};

Solution Solve(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
               const Eigen::VectorXd& variance) {
  const Eigen::VectorXd weight = variance.cwiseInverse();
  // Columns of the same size: one may be 1/L, the other 1.
  const Eigen::VectorXd scale = X.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd scaled = X * scale.asDiagonal();
  const Eigen::MatrixXd inverse = (scaled.transpose() * weight.asDiagonal() * scaled).inverse();
  Solution solution;
  solution.estimate =
      scale.asDiagonal() * (inverse * (scaled.transpose() * (weight.asDiagonal() * y)));
  solution.covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
  solution.chi_square = (y - X * solution.estimate).cwiseAbs2().dot(weight);
  return solution;
}

// Student's distribution function at t > 0, less 1/2, by Simpson's rule over the angle: with
// t = sqrt(n) tan(a) its density is a power of the cosine.
double StudentAbove(double t, double n) {
  const double scale = std::exp(std::lgamma((n + 1) / 2) - std::lgamma(n / 2)) / std::sqrt(kPi);
  const double end = std::atan(t / std::sqrt(n));
  constexpr int kPairs = 50;
  const double h = end / (2 * kPairs);
  double sum = 0;
  for (int i = 0; i <= 2 * kPairs; ++i) {
    const double weight = i == 0 || i == 2 * kPairs ? 1 : (i % 2 == 1 ? 4 : 2);
    sum += weight * std::pow(std::cos(i * h), n - 1);
  }
  return scale * sum * h / 3;
}

}  // namespace

double WeightedLine::sd(Eigen::Index k) const { return std::sqrt(covariance(k, k)); }

double StudentQuantile(double freedom) {
  if (freedom > kNormalFrom) return kNormal975;
  double low = 0, high = 20;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (StudentAbove(middle, freedom) < 0.475 ? low : high) = middle;
  }
  return (low + high) / 2;
}

double ChiSquareQuantile(int freedom) {
  // One is the square of a normal number; Wilson and Hilferty's cube is within 1 % from two on.
  if (freedom == 1) return kNormal975 * kNormal975;
  const double a = 2.0 / (9 * freedom);
  return freedom * std::pow(1 - a + kNormal95 * std::sqrt(a), 3);
}

WeightedLine FitWeightedLine(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                             const Eigen::VectorXd& variance) {
  WeightedLine line;
  Solution solution = Solve(X, y, variance);
  line.chi_square = solution.chi_square;
  line.freedom = static_cast<int>(X.rows() - X.cols());
  line.quantile = kNormal975;
  if (line.freedom > 0 && line.chi_square > line.freedom) {
    line.scatters = line.chi_square > ChiSquareQuantile(line.freedom);
    const auto with = [&](double added) {
      return Solve(X, y, (variance.array() + added).matrix());
    };
    // As much as the residuals' whole spread is too much.
    double low = 0, high = 10 * (y - X * solution.estimate).squaredNorm();
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (low + high) / 2;
      (with(middle).chi_square > line.freedom ? low : high) = middle;
    }
    solution = with(high);
    line.scatter = std::sqrt(high);
    const double share = high / (high + variance.mean());
    line.quantile = StudentQuantile(line.freedom / (share * share));
  }
  line.estimate = solution.estimate;
  line.covariance = solution.covariance;
  return line;
}

}  // namespace cosserat_cable
