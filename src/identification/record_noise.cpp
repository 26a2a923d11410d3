#include "record_noise.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <utility>

#include "column_span.h"
#include "uneven_transform.h"

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
// Of the correlation time's logarithm: to half a percent of the time and better.
constexpr int kBits = 12;

double Deviance(const Eigen::VectorXd& residual, const Eigen::MatrixXd& slopes,
                const NoiseCorrelation& noise) {
  Eigen::VectorXd white = residual;
  noise.Whiten(white);
  double freedom = static_cast<double>(residual.size());
  double lost = 0;
  if (slopes.cols() > 0) {
    Eigen::MatrixXd columns = slopes;
    noise.Whiten(columns);
    freedom -= static_cast<double>(columns.cols());
    const ColumnSpan span(std::move(columns));
    span.Leave(white);
    lost = span.LogDeterminantOfGram();
  }
  return freedom * std::log(std::max(white.squaredNorm() / freedom, 1e-300)) +
         noise.LogDeterminant() + lost;
}

NoiseCorrelation Exponential(const Eigen::ArrayXd& intervals, double time) {
  NoiseCorrelation noise;
  noise.correlation = Eigen::VectorXd::Zero(intervals.size() + 1);
  noise.correlation.tail(intervals.size()) = (-intervals / time).exp().min(kStrongest);
  return noise;
}

}  // namespace

CorrelationFit FitCorrelation(const Eigen::VectorXd& t, const Eigen::VectorXd& residual,
                              const Eigen::MatrixXd& slopes) {
  CorrelationFit white;
  white.deviance = Deviance(residual, slopes, white.noise);
  const Eigen::Index last = t.size() - 1;
  const Eigen::ArrayXd intervals = t.tail(last) - t.head(last);
  const double duration = t[last] - t[0];
  const auto deviance = [&](double log_time) {
    return Deviance(residual, slopes, Exponential(intervals, std::exp(log_time)));
  };
  // From nothing (correlation 1e-4 of neighbours) to the record's length.
  const auto [log_time, least] = boost::math::tools::brent_find_minima(
      deviance, std::log(0.11 * duration / static_cast<double>(last)), std::log(duration), kBits);
  CorrelationFit fit;
  fit.time = std::exp(log_time);
  fit.noise = Exponential(intervals, fit.time);
  fit.deviance = least;
  fit.parameters = 1;
  return fit.deviance < white.deviance - kClearly ? fit : white;
}

Periodogram MakePeriodogram(const Eigen::VectorXd& t, const Eigen::VectorXd& residual,
                            double decay) {
  const Eigen::Index n = std::min(t.size(), kMostSamples);
  const double duration = t[n - 1] - t[0];
  Periodogram result;
  result.step = kPi / duration;
  const double variance = std::max(residual.head(n).squaredNorm() / static_cast<double>(n), 1e-300);
  const Eigen::ArrayXd weight = (-decay * (t.head(n).array() - t[0])).exp();
  const Eigen::ArrayXd x = weight * residual.head(n).array();
  result.power =
      UnevenTransform(result.step * (t.head(n).array() - t[0]), x, n - 1).abs2().matrix() /
      (weight.square().sum() * variance);
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
