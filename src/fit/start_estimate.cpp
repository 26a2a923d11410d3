#include "cosserat_cable/fit/start_estimate.h"

#include <algorithm>

#include "cosserat_cable/fit/damage.h"
#include "cosserat_cable/fit/fit.h"
#include "cosserat_cable/fit/record_model.h"

namespace cosserat_cable {
namespace {

// Of the record; format.
constexpr double kPart = 0.1;
constexpr double kPeriods = 2;

}  // namespace

Specimen EstimateStart(const Experiment& experiment, const CableKeys& keys, Problems* problems) {
  MeasurementSet set;
  set.cable = keys;
  set.cable.uncertain = {std::vector<UncertainKey>(), experiment.mark};
  set.cable_mark = experiment.mark;
  set.experiments = {experiment};
  set.experiments.front().specimen = CableKeys();
  UnknownOptions options;
  options.end_damping = false;
  const Unknowns unknowns(set, options, problems);
  if (!problems->empty()) return {};
  if (unknowns.size() == 0) {
    problems->Add(experiment.mark,
                  "its start is unknown, and no rest of the cable was found about which it swings");
    return {};
  }
  RecordModel model(unknowns);
  Eigen::VectorXd values = unknowns.StartValues();
  const Specimen resting = unknowns.MakeSpecimen(0, values, problems);
  if (!problems->empty()) return resting;
  const std::vector<double>& t = experiment.record.t;
  const double until = t.front() + std::max(kPart * (t.back() - t.front()),
                                            kPeriods * SlowestPeriod(experiment, resting.cable));
  const Horizon horizon = {std::min(until, t.back())};
  const NoiseLevels noise = GuessNoise(model);
  // Once as the steps show it, then without their errors.
  for (const bool refined : {false, true}) {
    if (refined) model.Refine(values, noise);
    const FitResult fit = Fit(model, values, horizon, noise, {}, FitProgress());
    if (!fit.ok) {
      problems->Add(experiment.mark,
                    "its start is unknown, and could not be found from the record: " + fit.message);
      return resting;
    }
    values = fit.values;
  }
  return unknowns.MakeSpecimen(0, values, problems);
}

}  // namespace cosserat_cable
