// What a decaying oscillation tells: frequency and decay from its zeros and its extremes.
#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

namespace cosserat_cable::rod {

struct Ringing {
  double Omega, delta;  ///< damped angular frequency [rad/s], decay of the amplitude [1/s]

  double w() const { return std::hypot(Omega, delta); }  ///< without damping [rad/s]
  double zeta() const { return delta / w(); }
};

/// Of a signal about zero with one frequency in it, sampled every `dt` [s].
inline Ringing Listen(const std::vector<double>& x, double dt) {
  std::vector<double> zeros, peaks, times;
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    if (x[k - 1] * x[k] < 0) zeros.push_back((k - 1 + x[k - 1] / (x[k - 1] - x[k])) * dt);
    if ((x[k] - x[k - 1]) * (x[k + 1] - x[k]) < 0) {
      // Vertex of the parabola through three samples.
      const double curvature = x[k - 1] - 2 * x[k] + x[k + 1], slope = 0.5 * (x[k + 1] - x[k - 1]);
      peaks.push_back(std::abs(x[k] - 0.5 * slope * slope / curvature));
      times.push_back((k - slope / curvature) * dt);
    }
  }
  if (zeros.size() < 2 || peaks.size() < 2) throw std::runtime_error("no oscillation");
  return {M_PI * (zeros.size() - 1) / (zeros.back() - zeros.front()),
          std::log(peaks.front() / peaks.back()) / (times.back() - times.front())};
}

}  // namespace cosserat_cable::rod
