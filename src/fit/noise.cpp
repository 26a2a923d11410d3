#include "cosserat_cable/fit/noise.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

constexpr int kMaxOrder = 8;
constexpr int kSamplesPerOrder = 20;
constexpr double kDied = 1e-3;  // autocorrelation that counts as none
constexpr int kDifference = 6;

}  // namespace

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

  // Levinson and Durbin's recursion; the order with the least n log(error) + log(n) order
  // (Schwarz). Akaike's 2 order finds a colour in every fourth white record, and a wrong interval.
  std::vector<double> a, best;
  double error = 1, least = 0;
  for (int order = 1; order <= most; ++order) {
    double reflection = r[order];
    for (int k = 1; k < order; ++k) reflection -= a[k - 1] * r[order - k];
    reflection /= error;
    std::vector<double> next = a;
    next.push_back(reflection);
    for (int k = 1; k < order; ++k) next[k - 1] = a[k - 1] - reflection * a[order - k - 1];
    a = next;
    error *= 1 - reflection * reflection;
    if (!(error > 0)) break;
    const double criterion = n * std::log(error) + std::log(n) * order;
    if (criterion < least) {
      least = criterion;
      best = a;
    }
  }
  if (best.empty()) return colour;
  // The model's own autocorrelation.
  const auto order = static_cast<int>(best.size());
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

}  // namespace cosserat_cable
