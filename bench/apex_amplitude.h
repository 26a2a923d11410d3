// What the comparison judges: the amplitude of the apex over the sweep.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "swept_arch.h"

namespace cosserat_cable::bench {

/// Positions along the excitation [m] at dt, 2 dt, ... [s].
struct Track {
  double dt = 0;
  std::vector<double> x;
};

/// Amplitudes [m] at 1, 1.5, ... s, until 0.5 s before `end`: of the sine of the excitation's phase
/// that fits the track best within 0.1 s of each, so that it does not depend on where in a swing
/// the samples lie.
inline std::vector<double> Amplitudes(const Track& track, double end) {
  constexpr double kFirst = 1, kEvery = 0.5;  // s
  constexpr double kHalfWidth = 0.1;          // s: two periods at the slow end
  std::vector<double> amplitudes;
  for (int i = 0; kFirst + (i + 1) * kEvery <= end; ++i) {
    const double at = kFirst + i * kEvery;
    const int first = static_cast<int>(std::ceil((at - kHalfWidth) / track.dt)) - 1;
    const int last = static_cast<int>((at + kHalfWidth) / track.dt) - 1;
    Eigen::MatrixXd basis(last - first + 1, 6);
    Eigen::VectorXd x(last - first + 1);
    for (int k = first; k <= last; ++k) {
      const double t = (k + 1) * track.dt, phase = SweptArch::Phase(t);
      const double c = std::cos(phase), s = std::sin(phase), u = (t - at) / kHalfWidth;
      basis.row(k - first) << 1, u, c, s, u * c, u * s;
      x[k - first] = track.x[k];
    }
    const Eigen::VectorXd fit = basis.householderQr().solve(x);
    amplitudes.push_back(std::hypot(fit[2], fit[3]));
  }
  return amplitudes;
}

/// Largest relative difference between amplitudes.
inline double LargestError(const std::vector<double>& amplitudes,
                           const std::vector<double>& reference) {
  double error = 0;
  for (std::size_t i = 0; i < reference.size(); ++i)
    error = std::max(error, std::abs(amplitudes[i] / reference[i] - 1));
  return error;
}

}  // namespace cosserat_cable::bench
