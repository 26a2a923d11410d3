#include "cosserat_cable/fit/noise.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

constexpr int kMaxOrder = 8;
constexpr int kSamplesPerOrder = 20;
constexpr double kDied = 1e-3;  // autocorrelation that counts as none
constexpr int kDifference = 6;

/// The best linear prediction of a sample from those before it, the last one first, by a sequence's
/// autocorrelation (Levinson and Durbin).
struct Predictor {
  std::vector<double> weights;
  double error = 1;  ///< variance that it leaves, of one

  /// One sample farther back. False: nothing is left to be predicted.
  bool Grow(const std::vector<double>& autocorrelation) {
    const std::size_t order = weights.size() + 1;
    double reflection = autocorrelation[order];
    for (std::size_t k = 1; k < order; ++k)
      reflection -= weights[k - 1] * autocorrelation[order - k];
    reflection /= error;
    std::vector<double> next = weights;
    next.push_back(reflection);
    for (std::size_t k = 1; k < order; ++k)
      next[k - 1] = weights[k - 1] - reflection * weights[order - k - 1];
    weights = next;
    error *= 1 - reflection * reflection;
    return error > 0;
  }
};

}  // namespace

double RootMeanSquare(const Eigen::VectorXd& values) {
  return values.size() > 0 ? std::sqrt(values.squaredNorm() / static_cast<double>(values.size()))
                           : 0.0;
}

double NoiseOfSmooth(const Eigen::VectorXd& samples, const Eigen::VectorXd& usable) {
  Eigen::VectorXd d = samples;
  Eigen::VectorXd counts =
      usable.size() > 0 ? usable : Eigen::VectorXd(Eigen::VectorXd::Ones(samples.size()));
  double gain = 1;  // variance that white noise has after the differences: (2k)!/(k!)^2
  for (int k = 1; k <= kDifference && d.size() > 2; ++k) {
    const Eigen::Index n = d.size() - 1;
    d = (d.tail(n) - d.head(n)).eval();
    counts = counts.tail(n).cwiseProduct(counts.head(n)).eval();
    gain *= 2.0 * (2 * k - 1) / k;
  }
  std::vector<double> size;
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (counts[i] > 0) size.push_back(std::abs(d[i]));
  if (size.empty()) return 0;
  // The median resists jumps: 0.6745 of a normal distribution's standard deviation.
  std::nth_element(size.begin(), size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2),
                   size.end());
  return size[size.size() / 2] / 0.6745 / std::sqrt(gain);
}

NoiseColour ColourOf(const Eigen::VectorXd& residuals) {
  NoiseColour colour;
  const auto n = static_cast<int>(residuals.size());
  const double variance = residuals.squaredNorm() / std::max(n, 1);
  colour.sd = std::sqrt(variance);
  colour.autocorrelation = {1.0};
  const int most = std::min(kMaxOrder, n / kSamplesPerOrder);
  if (most < 1 || !(variance > 0)) return colour;
  std::vector<double> r(most + 1);
  for (int k = 0; k <= most; ++k)
    r[k] = residuals.head(n - k).dot(residuals.tail(n - k)) / n / variance;

  // The order with the least n log(error) + log(n) order (Schwarz). Akaike's 2 order finds a colour
  // in every fourth white record, and a wrong interval.
  Predictor predictor;
  std::vector<double> best;
  double least = 0;
  for (int order = 1; order <= most && predictor.Grow(r); ++order) {
    const double criterion = n * std::log(predictor.error) + std::log(n) * order;
    if (criterion < least) {
      least = criterion;
      best = predictor.weights;
    }
  }
  if (best.empty()) return colour;
  // The model's own autocorrelation.
  const auto order = static_cast<int>(best.size());
  colour.order = order;
  colour.autocorrelation.assign(r.begin(), r.begin() + order + 1);
  std::vector<double>& rho = colour.autocorrelation;
  while (static_cast<int>(rho.size()) < n / 4) {
    double next = 0;
    for (int k = 1; k <= order; ++k) next += best[k - 1] * rho[rho.size() - k];
    rho.push_back(next);
    double recent = 0;
    for (int k = 0; k < order; ++k) recent = std::max(recent, std::abs(rho[rho.size() - 1 - k]));
    if (recent < kDied) break;
  }
  for (std::size_t k = 1; k < rho.size(); ++k) colour.correlation_samples += 2 * rho[k];
  colour.correlation_samples = std::max(colour.correlation_samples, 1.0 / n);
  return colour;
}

Whitened Whiten(const Eigen::VectorXd& residuals, const NoiseColour& colour, double sd) {
  constexpr double kLogTurn = 1.8378770664093453;  // log(2 pi)
  Whitened white;
  white.residuals.resize(residuals.size());
  Predictor predictor;
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    const auto known = static_cast<Eigen::Index>(predictor.weights.size());
    double foretold = 0;
    for (Eigen::Index k = 0; k < known; ++k)
      foretold += predictor.weights[static_cast<std::size_t>(k)] * residuals[i - 1 - k];
    const double own_sd = sd * std::sqrt(predictor.error);
    white.residuals[i] = (residuals[i] - foretold) / own_sd;
    white.log_likelihood -=
        0.5 * (kLogTurn + 2 * std::log(own_sd) + white.residuals[i] * white.residuals[i]);
    if (known < colour.order) predictor.Grow(colour.autocorrelation);
  }
  return white;
}

}  // namespace cosserat_cable
