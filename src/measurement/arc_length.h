// A place on the cable as a set gives it.
#pragma once

#include <optional>
#include <string>

#include "cosserat_cable/input/yaml_value.h"

namespace cosserat_cable {

/// What is wrong with an arc length [m], or "". One beyond the length by rounding becomes the
/// length. @param length the cable's [m], where it is known
std::string ArcLengthProblem(double* s, const std::optional<double>& length);

/// Reads an arc length [m] in [0, length].
std::optional<double> ReadArcLength(const YamlValue& value, const std::optional<double>& length);

}  // namespace cosserat_cable
