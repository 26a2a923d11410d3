#include "record_noise.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Eigen::Index kMostSamples = 8000;
// -2 ln(likelihood) by which correlation must beat white noise: chance does in one of 10,000.
constexpr double kClearly = 13.8;
constexpr double kStrongest = 0.9995;

double Deviance(const Eigen::VectorXd& residual, const NoiseCorrelation& noise) {
  Eigen::VectorXd white = residual;
  noise.Whiten(white);
  const double n = static_cast<double>(residual.size());
  return n * std::log(std::max(white.squaredNorm() / n, 1e-300)) + noise.LogDeterminant();
}

NoiseCorrelation Exponential(const Eigen::VectorXd& t, double time) {
  NoiseCorrelation noise;
  noise.correlation = Eigen::VectorXd::Zero(t.size());
  for (Eigen::Index i = 1; i < t.size(); ++i) {
    noise.correlation[i] = std::min(std::exp(-(t[i] - t[i - 1]) / time), kStrongest);
  }
  return noise;
}

}  // namespace

CorrelationFit FitCorrelation(const Eigen::VectorXd& t, const Eigen::VectorXd& residual) {
  CorrelationFit white;
  white.deviance = Deviance(residual, white.noise);
  const double mean_step = (t[t.size() - 1] - t[0]) / static_cast<double>(t.size() - 1);
  const auto deviance = [&](double log_time) {
    return Deviance(residual, Exponential(t, std::exp(log_time)));
  };
  // From nothing (correlation 1e-4 of neighbours) to the record's length; golden section.
  double low = std::log(0.11 * mean_step), high = std::log(t[t.size() - 1] - t[0]);
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = deviance(a), at_b = deviance(b);
  while (high - low > 0.01) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - golden * (high - low);
      at_a = deviance(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + golden * (high - low);
      at_b = deviance(b);
    }
  }
  CorrelationFit fit;
  fit.time = std::exp((low + high) / 2);
  fit.noise = Exponential(t, fit.time);
  fit.deviance = Deviance(residual, fit.noise);
  fit.parameters = 1;
  return fit.deviance < white.deviance - kClearly ? fit : white;
}

Eigen::Index Periodogram::Peak() const {
  Eigen::Index peak = 0;
  power.maxCoeff(&peak);
  return peak;
}

bool Periodogram::PeakIsSignificant() const {
  // Half of the frequencies are independent: the grid is twice as fine as the record resolves.
  const double independent = static_cast<double>(power.size()) / 2;
  return power[Peak()] > std::log(independent / 0.01);
}

Periodogram MakePeriodogram(const Eigen::VectorXd& t, const Eigen::VectorXd& residual) {
  const Eigen::Index n = std::min(t.size(), kMostSamples);
  const double duration = t[n - 1] - t[0];
  Periodogram result;
  result.step = kPi / duration;
  result.power.resize(n - 1);
  const double variance = std::max(residual.head(n).squaredNorm() / static_cast<double>(n), 1e-300);
  const Eigen::VectorXd x = residual.head(n);
  // Turned on from one frequency to the next: no sine per sample and frequency.
  const Eigen::ArrayXcd turn =
      (std::complex<double>(0, -1) * result.step * (t.head(n).array() - t[0])).exp();
  Eigen::ArrayXcd turned =
      (std::complex<double>(0, -0.5) * result.step * (t.head(n).array() - t[0])).exp() * x.array();
  for (Eigen::Index k = 0; k < result.power.size(); ++k) {
    result.power[k] = std::norm(turned.sum()) / (static_cast<double>(n) * variance);
    turned *= turn;
  }
  return result;
}

}  // namespace cosserat_cable
