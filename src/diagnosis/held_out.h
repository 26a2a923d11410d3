// What a model predicts of records that its fit has not seen.
#pragma once

#include "cosserat_cable/diagnosis/diagnosis.h"
#include "goodness.h"

namespace cosserat_cable {

/// Residuals of each record by a fit without it, as far as derivatives tell: one step of Gauss and
/// Newton from the fit of all. What concerns that record alone is fitted to it.
Records LinearisedHeldOut(const FitPoint& point);

/// A set with its free parameters, where a fit of all records ended.
struct FittedModel {
  const MeasurementSet& set;
  const FitPoint& point;
  const FitProblem& problem;
};
/// Residuals of each record by a fit without it; of a set with one experiment, of the last part of
/// its record by a fit of the first. Empty matrices where that cannot be fitted or simulated.
Records ExactHeldOut(const FittedModel& model, const FitProblemOptions& options);

/// Residuals of the experiments of a set that a fit of the `fitted` ones has not seen, each with
/// its start found from its beginning.
Records PredictOthers(const MeasurementSet& set, const std::vector<int>& fitted,
                      const FitPoint& point, const FitProblemOptions& options);

/// (MSE_baseline - MSE_extended)/(MSE_baseline - noise^2), all in the noise's variance, with a 95 %
/// interval by bootstrap over blocks of the records. Nothing where no record was predicted by both,
/// or the baseline leaves no more than noise.
std::optional<GainEstimate> GainOf(const Records& baseline, const Records& extended);

}  // namespace cosserat_cable
