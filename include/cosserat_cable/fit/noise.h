// The noise of a channel: its size before a fit, and its colour after.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cosserat_cable {

/// Zero for no values.
double RootMeanSquare(const Eigen::VectorXd& values);

/// Standard deviation of the noise of a smooth signal, from differences of high order: what is left
/// of it where the signal is resolved by its samples, a little too much where it is not. Samples
/// for which `usable` is zero, where it is given, do not count.
double NoiseOfSmooth(const Eigen::VectorXd& samples,
                     const Eigen::VectorXd& usable = Eigen::VectorXd());

/// An autoregressive model of residuals, of the order that Schwarz's criterion asks for.
struct NoiseColour {
  double sd = 0;                        ///< marginal
  std::vector<double> autocorrelation;  ///< at lags 0, 1, ...: until it has died away
  /// Sum over all lags: how many samples count as one, for a signal that varies slowly.
  double correlation_samples = 1;
  int order = 0;  ///< of the model: so many samples foretell the next
};
NoiseColour ColourOf(const Eigen::VectorXd& residuals);

/// Residuals of coloured noise, made white: of each, what the ones before it do not foretell.
struct Whitened {
  Eigen::VectorXd residuals;  ///< over their own standard deviations
  double log_likelihood = 0;  ///< of the residuals as they were, normally distributed
};
/// Of residuals with this colour and this standard deviation, by Levinson and Durbin's recursion
/// over the colour's autocorrelation: the likelihood is that of all samples together.
Whitened Whiten(const Eigen::VectorXd& residuals, const NoiseColour& colour, double sd);

}  // namespace cosserat_cable
