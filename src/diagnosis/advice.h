// The next experiment: the one in which the models that the data cannot tell apart differ most.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "design_menu.h"
#include "diagnosis_work.h"

namespace cosserat_cable {

/// In which all of the rivals differ from the best, each refitted to what it has seen and to the
/// new record: by the sum of squares that stays, in the noise of the experiment that is varied
/// (T-optimality: Atkinson and Fedorov 1975). Empty where no design would tell them apart.
std::string NextExperiment(const MeasurementSet& set, const NoiseLevels& noise,
                           const MotionScales& scales, const FittedTrial& best,
                           const std::vector<const FittedTrial*>& rivals,
                           const std::function<bool()>& stop);

}  // namespace cosserat_cable
