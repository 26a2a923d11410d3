// How well a model fits, beside the noise, and whether one fits better than another.
#pragma once

#include <vector>

#include "cosserat_cable/fit/fit_problem.h"

namespace cosserat_cable {

/// By experiment and channel: how many residuals in a row are worth one, from what a model leaves.
using Correlations = std::vector<Eigen::VectorXd>;
Correlations CorrelationsOf(const FitPoint& point);

/// Whether what a model leaves is noise.
struct Adequacy {
  double chi2 = 0;      ///< sum of squares of the residuals [noise variances]
  double expected = 0;  ///< what noise alone would leave
  double sd = 0;        ///< of that: by chance, the noise's colour and how well its level is known
  bool adequate = false;

  /// chi2 by what is expected of noise.
  double times() const { return expected > 0 ? chi2 / expected : 0; }
  double excess() const { return chi2 - expected; }
};
Adequacy AdequacyOf(const FitPoint& point, const SetNoise& noise);

/// By how much a model fits worse than another: sums of squares, each channel's divided by its
/// correlation, so that they count as of independent samples.
struct Difference {
  double value = 0;
  double se = 0;  ///< of the sum of paired differences over blocks of the records
  /// The largest of any record: what it gains on average per sample [noise variances].
  double most_per_sample = 0;
};
/// @pre both are points of the same records
Difference DifferenceOf(const Records& worse, const Records& better,
                        const Correlations& correlations);

}  // namespace cosserat_cable
