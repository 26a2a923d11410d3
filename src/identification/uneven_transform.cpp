#include "uneven_transform.h"

#include <array>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace cosserat_cable {
namespace {

using Complex = std::complex<double>;

constexpr double kPi = 3.14159265358979323846;
// Points of the grid on either side over which a value is spread: what is cut off is 1e-12 of it
// where the grid is twice as fine as the frequencies ask for.
constexpr int kSpread = 11;

// A grid at least twice as fine as the frequencies ask for.
Eigen::Index GridFor(Eigen::Index count) {
  Eigen::Index size = 4 * kSpread;
  while (size < 2 * count) size *= 2;
  return size;
}

}  // namespace

Eigen::ArrayXcd UnevenTransform(const Eigen::ArrayXd& phase, const Eigen::ArrayXd& x,
                                Eigen::Index count) {
  const Eigen::Index size = GridFor(count);
  const double step = 2 * kPi / static_cast<double>(size);
  const double n = static_cast<double>(count);
  const double oversampling = static_cast<double>(size) / n;
  // Variance/2 of the Gaussian that balances what is cut off it with what it aliases.
  const double tau = kPi * kSpread / (n * n * oversampling * (oversampling - 0.5));
  // The Gaussian at the grid's points, in the product form that takes one exponential per value.
  std::array<double, kSpread + 1> at_points;
  for (int l = 0; l <= kSpread; ++l) at_points[l] = std::exp(-std::pow(l * step, 2) / (4 * tau));
  std::vector<Complex> grid(static_cast<std::size_t>(size));
  const auto place = [&](Eigen::Index at) -> Complex& {
    return grid[static_cast<std::size_t>((at + size) % size)];
  };
  // The middle of the frequencies is the transform's zero.
  const double middle = 0.5 + static_cast<double>(count / 2);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const auto below = static_cast<Eigen::Index>(phase[j] / step);
    const double beyond = phase[j] - static_cast<double>(below) * step;
    const Complex value =
        std::polar(x[j] * std::exp(-beyond * beyond / (4 * tau)), -middle * phase[j]);
    const double ratio = std::exp(beyond * step / (2 * tau));
    double up = 1, down = 1;
    place(below) += value;
    for (int l = 1; l <= kSpread; ++l) {
      up *= ratio;
      down /= ratio;
      place(below + l) += at_points[l] * up * value;
      if (l < kSpread) place(below - l) += at_points[l] * down * value;
    }
  }
  std::vector<Complex> transformed;
  Eigen::FFT<double>().fwd(transformed, grid);
  Eigen::ArrayXcd sums(count);
  const double scale = std::sqrt(kPi / tau) / static_cast<double>(size);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index from_middle = k - count / 2;
    const double frequency = static_cast<double>(from_middle);
    sums[k] = scale * std::exp(tau * frequency * frequency) *
              transformed[static_cast<std::size_t>((from_middle + size) % size)];
  }
  return sums;
}

}  // namespace cosserat_cable
