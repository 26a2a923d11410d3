#include "record_noise.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Eigen::Index kMostSamples = 8000;
// Of the weights under which peaks are looked for, times the record's duration.
constexpr double kDecays[] = {0, 5, 20};
// Share of records of noise alone with a peak that counts as significant.
constexpr double kChance = 0.01;
// -2 ln(likelihood) by which correlation must beat white noise: chance does in one of 10,000.
constexpr double kClearly = 13.8;
constexpr double kStrongest = 0.9995;

double Deviance(const Eigen::VectorXd& residual, const Eigen::MatrixXd& slopes,
                const NoiseCorrelation& noise) {
  Eigen::VectorXd white = residual;
  noise.Whiten(white);
  double freedom = static_cast<double>(residual.size());
  double lost = 0;
  if (slopes.cols() > 0) {
    Eigen::MatrixXd columns = slopes;
    noise.Whiten(columns);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
    white = (qr.householderQ().adjoint() * white).eval();
    white.head(columns.cols()).setZero();
    freedom -= static_cast<double>(columns.cols());
    lost = 2 * qr.matrixQR().diagonal().cwiseAbs().array().log().sum();
  }
  return freedom * std::log(std::max(white.squaredNorm() / freedom, 1e-300)) +
         noise.LogDeterminant() + lost;
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

CorrelationFit FitCorrelation(const Eigen::VectorXd& t, const Eigen::VectorXd& residual,
                              const Eigen::MatrixXd& slopes) {
  CorrelationFit white;
  white.deviance = Deviance(residual, slopes, white.noise);
  const double mean_step = (t[t.size() - 1] - t[0]) / static_cast<double>(t.size() - 1);
  const auto deviance = [&](double log_time) {
    return Deviance(residual, slopes, Exponential(t, std::exp(log_time)));
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
  fit.deviance = Deviance(residual, slopes, fit.noise);
  fit.parameters = 1;
  return fit.deviance < white.deviance - kClearly ? fit : white;
}

Periodogram MakePeriodogram(const Eigen::VectorXd& t, const Eigen::VectorXd& residual,
                            double decay) {
  const Eigen::Index n = std::min(t.size(), kMostSamples);
  const double duration = t[n - 1] - t[0];
  Periodogram result;
  result.step = kPi / duration;
  result.power.resize(n - 1);
  const double variance = std::max(residual.head(n).squaredNorm() / static_cast<double>(n), 1e-300);
  const Eigen::ArrayXd weight = (-decay * (t.head(n).array() - t[0])).exp();
  const Eigen::ArrayXd x = weight * residual.head(n).array();
  // Turned on from one frequency to the next: no sine per sample and frequency.
  const Eigen::ArrayXcd turn =
      (std::complex<double>(0, -1) * result.step * (t.head(n).array() - t[0])).exp();
  Eigen::ArrayXcd turned =
      (std::complex<double>(0, -0.5) * result.step * (t.head(n).array() - t[0])).exp() * x;
  for (Eigen::Index k = 0; k < result.power.size(); ++k) {
    result.power[k] = std::norm(turned.sum()) / (weight.square().sum() * variance);
    turned *= turn;
  }
  return result;
}

Peak HighestPeak(const Eigen::VectorXd& t, const Eigen::VectorXd& residual) {
  const double duration = t[std::min(t.size(), kMostSamples) - 1] - t[0];
  Peak peak;
  double frequencies = 0;
  for (const double decay : kDecays) {
    const Periodogram periodogram = MakePeriodogram(t, residual, decay / duration);
    // The grid is twice as fine as the record resolves.
    frequencies += static_cast<double>(periodogram.power.size()) / 2;
    Eigen::Index k = 0;
    const double power = periodogram.power.maxCoeff(&k);
    if (power <= peak.power) continue;
    peak = {periodogram.omega(k), periodogram.step, power, false};
  }
  peak.significant = peak.power > std::log(frequencies / kChance);
  return peak;
}

}  // namespace cosserat_cable
