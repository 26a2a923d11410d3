// How an end of the cable is held, as a set says it.
#pragma once

#include <string>

#include "cosserat_cable/input/yaml_value.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Reads an experiment's `a` or `b`; end a is a clamp.
EndCondition ReadEnd(const std::string& folder, const YamlValue& value, ClampSide side,
                     Problems* problems);

/// True where the end may turn about the cable's axis.
bool TurnsAboutAxis(const EndCondition& end);

}  // namespace cosserat_cable
