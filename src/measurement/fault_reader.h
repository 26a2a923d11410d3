// `faults`: what a record or its rig does otherwise than the set says.
#pragma once

#include <string>

#include "cosserat_cable/input/yaml_value.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Reads the `faults` of a set or of an experiment.
CableKey<Faults> ReadFaults(const YamlValue& value);

/// Reports faults that the set's experiments cannot have: of one its own; of the set, what none of
/// those that go by it can have. And names in `uncertain` of faults that there are not.
void CheckFaults(const MeasurementSet& set, Problems* problems);

/// The entry as YAML lines behind `indent`, its key included; "" where there is none.
std::string WriteFaults(const CableKey<Faults>& faults, const std::string& indent);

}  // namespace cosserat_cable
