// One experiment of a set, with the files that it names.
#pragma once

#include <string>

#include "cosserat_cable/input/yaml_value.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Reads one item of `experiments`.
/// @param set its folder and cable are known
Experiment ReadExperiment(const YamlValue& value, const MeasurementSet& set, Problems* problems);

}  // namespace cosserat_cable
