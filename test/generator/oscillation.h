#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include "rod_dynamics.h"

namespace cosserat_cable::generator {

/// Eigenvalues [1/s] with positive imaginary part of small motion about the rest shape q, lowest
/// frequency first.
inline std::vector<std::complex<double>> modesAbout(RodDynamics& rod, const Eigen::VectorXd& q) {
  const int n = rod.size();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd M, D, K;
  rod.linearise(0.0, q, zero, zero, &M, &D, &K);
  // In 1/lambda, so that the slow modes are the large eigenvalues, which come out precisely.
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(K);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -lu.solve(M);
  A.bottomRightCorner(n, n) = -lu.solve(D);
  const Eigen::VectorXcd values = A.eigenvalues();
  std::vector<std::complex<double>> modes;
  for (const std::complex<double>& value : values) {
    if (value.imag() < -1e-6 * std::abs(value)) modes.push_back(1.0 / value);
  }
  std::sort(modes.begin(), modes.end(),
            [](const auto& a, const auto& b) { return a.imag() < b.imag(); });
  return modes;
}

/// Complex frequency -delta + i Omega [1/s] of samples at even spacing dt of one decaying
/// oscillation about zero.
inline std::complex<double> decayOf(const Eigen::VectorXd& x, double dt) {
  const Eigen::Index n = x.size() - 2;
  Eigen::MatrixXd A(n, 2);
  A.col(0) = x.segment(1, n);
  A.col(1) = x.head(n);
  const Eigen::Vector2d c = (A.transpose() * A).partialPivLu().solve(A.transpose() * x.tail(n));
  const double delta = -0.5 * std::log(-c[1]) / dt;
  return {-delta, std::acos(0.5 * c[0] / std::sqrt(-c[1])) / dt};
}

/// Where f changes its sign between low and high.
inline double root(const std::function<double(double)>& f, double low, double high) {
  const double left = f(low);
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) * left > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace cosserat_cable::generator
