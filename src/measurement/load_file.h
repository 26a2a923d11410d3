// Known forces on the cable: constant ones in the set itself, or a file of them.
#pragma once

#include "cosserat_cable/measurement/measurement_set.h"
#include "csv_table.h"

namespace cosserat_cable {

/// Reads an experiment's `load`; an absent one has no samples.
/// @param length the cable's [m], where it is known
ExperimentLoad ReadLoad(const std::string& folder, const YamlValue& value,
                        const std::optional<double>& length, Problems* problems);

}  // namespace cosserat_cable
