// How an experiment's motion begins, as a set says it.
#pragma once

#include "cosserat_cable/input/yaml_value.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Reads an experiment's `start`. @param length the cable's [m], where it is known
StartCondition ReadStart(const YamlValue& value, const std::optional<double>& length);

}  // namespace cosserat_cable
