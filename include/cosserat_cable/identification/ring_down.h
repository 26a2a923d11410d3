// Frequencies and decay rates of a ring-down, from the record itself: nonlinear least squares with
// as many decaying oscillations as rise above the noise, no picked peaks.
//
//     RingDownFit fit = FitRingDown(t, y);
//     if (!fit.refused.empty()) ...  // it says why there is no number
//     fit.modes.front().omega
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace cosserat_cable {

/// exp(-delta t) (cosine cos(omega t) + sine sin(omega t)), t from the first sample.
struct RingDownMode {
  double omega =
      0;  ///< damped angular frequency Omega [rad/s]; of small amplitudes where it shifts
  double delta = 0;  ///< decay rate [1/s]
  /// Of (omega, delta): with the noise's spectrum at this frequency, its correlation included.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double cosine = 0, sine = 0;  ///< at the first sample, in the record's unit
  double strength = 0;          ///< root mean square over the record, in the record's unit
  /// By how much of omega the frequency is higher at the first sample's amplitude, where that
  /// shows; it falls with the amplitude's square. 0 where it does not show.
  double amplitude_shift = 0;
  bool shifts = false;

  double amplitude() const;  ///< at the first sample
};

/// What does not swing: value exp(-rate t).
struct RingDownCreep {
  double rate = 0;  ///< [1/s]
  double value = 0;
};

struct RingDownFit {
  std::string refused;              ///< why there is no result; then all below is empty
  std::vector<RingDownMode> modes;  ///< the strongest first; at least one
  std::vector<RingDownCreep> creep;
  double offset = 0;
  double sigma = 0;             ///< the noise's standard deviation
  double correlation_time = 0;  ///< [s] in which the noise's correlation falls to 1/e; 0: white
  /// Power of the residual, made white, at its highest peak over what white noise has on average.
  double residual_peak = 0;
  bool residual_is_noise = true;  ///< whether noise alone has a peak as high in one of 100 records
  Eigen::VectorXd fit;            ///< at the record's times
  std::vector<std::string> messages;  ///< what a user should know; may be empty
};

/// `sigma`, the noise's standard deviation, is estimated where it is not given; where the residual
/// is larger than given, the residual counts. Refused are records that are too short (fewer than
/// 16 samples, less than a period of the strongest oscillation), constant, clipped, frozen, not
/// finite, that grow, or in which no oscillation rises above the noise.
RingDownFit FitRingDown(const std::vector<double>& t, const Eigen::VectorXd& y,
                        std::optional<double> sigma = std::nullopt);

}  // namespace cosserat_cable
