#include "relaxation.h"

#include <Eigen/QR>
#include <cmath>

namespace cosserat_cable::generator {
namespace {

/// Integrals over s from 0 to 1 of x exp(-x (1 - s)) s^k for k = 0 to 3.
std::array<double, 4> decayMoments(double x) {
  std::array<double, 4> I{};
  if (x < 1.0) {  // the recursion cancels
    for (int k = 0; k < 4; ++k) {
      double term = x / (k + 1.0), sum = 0.0;
      for (int j = 0; j < 20; ++j) {
        sum += term;
        term *= -x / (k + j + 2.0);
      }
      I[k] = sum;
    }
    return I;
  }
  I[0] = -std::expm1(-x);
  for (int k = 1; k < 4; ++k) I[k] = 1.0 - k / x * I[k - 1];
  return I;
}

}  // namespace

Points Relaxation::internal(const SectionState& at, size_t branch) const {
  const double h = at.t - t_;
  if (h <= 0.0) return z_[branch];
  const double x = h / branches_[branch].tau;
  const auto I = decayMoments(x);
  // Hermite's cubic: values and slopes at 0 and 1.
  const double left = I[0] - 3.0 * I[2] + 2.0 * I[3], right = 3.0 * I[2] - 2.0 * I[3];
  const double left_slope = h * (I[1] - 2.0 * I[2] + I[3]), right_slope = h * (I[3] - I[2]);
  return std::exp(-x) * z_[branch] + left * K_ + right * at.K + left_slope * Kd_ +
         right_slope * at.Kd;
}

void Relaxation::addMoments(const SectionState& at, Points* M) const {
  if (at.settled || z_.empty()) return;
  for (size_t b = 0; b < branches_.size(); ++b) {
    *M += branches_[b].C.asDiagonal() * (at.K - internal(at, b));
  }
}

void Relaxation::commit(const SectionState& at, const ClampTurn*) {
  if (at.settled || z_.empty()) {
    z_.assign(branches_.size(), at.K);
  } else {
    for (size_t b = 0; b < branches_.size(); ++b) z_[b] = internal(at, b);
  }
  t_ = at.t;
  K_ = at.K;
  Kd_ = at.Kd;
}

std::vector<double> constantLossSeries(const std::vector<double>& tau, double loss) {
  constexpr int kFrequencies = 90;
  const double low = std::log(0.02), high = std::log(500.0), turn = 2.0 * std::acos(-1.0);
  Eigen::MatrixXd A(kFrequencies, tau.size());
  for (int i = 0; i < kFrequencies; ++i) {
    const double w = turn * std::exp(low + (high - low) * i / (kFrequencies - 1.0));
    for (size_t j = 0; j < tau.size(); ++j) {
      const double x = w * tau[j];
      A(i, j) = (x - loss * x * x) / (1.0 + x * x);
    }
  }
  const Eigen::VectorXd right = Eigen::VectorXd::Constant(kFrequencies, loss);
  const Eigen::VectorXd share = A.colPivHouseholderQr().solve(right);
  return {share.data(), share.data() + share.size()};
}

}  // namespace cosserat_cable::generator
