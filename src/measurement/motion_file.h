// How a clamp moves: a file of poses.
#pragma once

#include "cosserat_cable/measurement/measurement_set.h"
#include "csv_table.h"

namespace cosserat_cable {

/// Reads the motion file that the set names at `value`.
std::optional<ClampMotion> ReadMotion(const std::string& folder, const YamlValue& value,
                                      Problems* problems);

}  // namespace cosserat_cable
