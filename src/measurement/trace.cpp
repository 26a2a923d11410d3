#include "trace.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

constexpr int kPoints = 6;

/// Weights of the values at 0, 1, ..., count - 1 for the derivative of the polynomial through them
/// at x: Fornberg's recursion (Mathematics of Computation 51, 1988).
void DerivativeWeights(double x, int count, int order, double* weights) {
  double table[kPoints][3] = {};
  table[0][0] = 1;
  double c1 = 1;
  double c4 = -x;
  for (int i = 1; i < count; ++i) {
    const int top = std::min(i, order);
    double c2 = 1;
    const double c5 = c4;
    c4 = i - x;
    for (int j = 0; j < i; ++j) {
      const double c3 = i - j;
      c2 *= c3;
      if (j == i - 1) {
        for (int k = top; k > 0; --k)
          table[i][k] = c1 * (k * table[i - 1][k - 1] - c5 * table[i - 1][k]) / c2;
        table[i][0] = -c1 * c5 * table[i - 1][0] / c2;
      }
      for (int k = top; k > 0; --k) table[j][k] = (c4 * table[j][k] - k * table[j][k - 1]) / c3;
      table[j][0] = c4 * table[j][0] / c3;
    }
    c1 = c2;
  }
  for (int i = 0; i < count; ++i) weights[i] = table[i][order];
}

}  // namespace

double Unwrapped(double angle, double near) {
  constexpr double kTurn = 6.283185307179586;
  return angle - kTurn * std::round((angle - near) / kTurn);
}

void Trace::Unwrap(int quantity) {
  for (Eigen::Index step = 1; step < rows_.cols(); ++step)
    rows_(quantity, step) = Unwrapped(rows_(quantity, step), rows_(quantity, step - 1));
}

int Trace::FirstOf(int step, int count) const {
  return std::clamp(step - kPoints / 2 + 1, 0, std::max(0, steps() - count));
}

std::array<double, 6> Trace::Polynomial(int quantity, int step) const {
  // Inverse of the powers of 0, 1, ..., 5 minus the place of `step` among them, by that place.
  using Matrix = Eigen::Matrix<double, kPoints, kPoints>;
  static const std::array<Matrix, kPoints> inverses = [] {
    std::array<Matrix, kPoints> all;
    for (int place = 0; place < kPoints; ++place) {
      Matrix powers;
      for (int i = 0; i < kPoints; ++i)
        for (int n = 0; n < kPoints; ++n) powers(i, n) = std::pow(i - place, n);
      all[static_cast<std::size_t>(place)] = powers.inverse();
    }
    return all;
  }();
  std::array<double, 6> coefficients{};
  const int count = std::min(kPoints, steps());
  const int first = FirstOf(step, count);
  Eigen::Map<Eigen::Matrix<double, kPoints, 1>> c(coefficients.data());
  if (count == kPoints) {
    c = inverses[static_cast<std::size_t>(step - first)] *
        rows_.row(quantity).segment<kPoints>(first).transpose();
    return coefficients;
  }
  Eigen::MatrixXd powers(count, count);
  for (int i = 0; i < count; ++i)
    for (int n = 0; n < count; ++n) powers(i, n) = std::pow(first + i - step, n);
  c.head(count) = powers.inverse() * rows_.row(quantity).segment(first, count).transpose();
  return coefficients;
}

double Trace::Evaluate(int quantity, double t, int order) const {
  const int count = std::min(kPoints, steps());
  const double x = (t - start_) / dt_;
  const int first = FirstOf(static_cast<int>(std::floor(x)), count);
  double weights[kPoints];
  DerivativeWeights(x - first, count, order, weights);
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += weights[i] * rows_(quantity, first + i);
  return sum / std::pow(dt_, order);
}

}  // namespace cosserat_cable
