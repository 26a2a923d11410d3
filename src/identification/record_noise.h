// What the noise of a record looks like: its correlation from one sample to the next, its spectrum.
#pragma once

#include <Eigen/Core>

#include "damped_terms.h"

namespace cosserat_cable {

struct CorrelationFit {
  NoiseCorrelation noise;
  double time = 0;        ///< [s] in which the correlation falls to 1/e; 0: white
  double deviance = 0;    ///< -2 ln(likelihood) of the residual with it
  double parameters = 0;  ///< that were estimated: 1, or 0 where it is white
};

/// White noise, or, where that is clearly likelier, noise whose correlation falls exponentially
/// over time, at these times. `slopes`: derivatives of the fit that left this residual by what it
/// adjusted, whose part of the noise is then counted (the restricted likelihood); may be empty.
CorrelationFit FitCorrelation(const Eigen::VectorXd& t, const Eigen::VectorXd& residual,
                              const Eigen::MatrixXd& slopes = Eigen::MatrixXd());

struct Periodogram {
  double step = 0;        ///< [rad/s] from one frequency to the next, the first being half of that
  Eigen::VectorXd power;  ///< over the mean of white noise: exponentially distributed, mean 1

  double omega(Eigen::Index k) const { return (static_cast<double>(k) + 0.5) * step; }
};

/// Of a residual at uneven times, up to half the mean sampling rate; long ones from their first
/// 8,000 samples. What has decayed counts less: samples are weighted with exp(-decay t) [1/s].
Periodogram MakePeriodogram(const Eigen::VectorXd& t, const Eigen::VectorXd& residual,
                            double decay = 0);

struct Peak {
  double omega = 0;  ///< [rad/s]
  double step = 0;   ///< [rad/s] of the periodogram
  double power = 0;
  bool significant = false;  ///< whether white noise has one as high in less than 1 of 100 records
};

/// The highest of periodograms with several decays.
Peak HighestPeak(const Eigen::VectorXd& t, const Eigen::VectorXd& residual);

}  // namespace cosserat_cable
