// Where a recording moves the clamps of a vehicle's cables, as motion files of a measurement set.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/ros/inputs.h"

namespace cosserat_cable {

/// The names of the files that WriteClampMotions writes: NAME_a.csv and NAME_b.csv of each cable.
std::vector<std::string> ClampMotionFiles(const Inputs& inputs);

/// Writes folder/NAME_a.csv and folder/NAME_b.csv for each cable: t [s], time of stamps; x, y, z
/// [m] and qx, qy, qz, qw of its clamps in the inertial frame, at the instants of telemetry. Where
/// transforms are missing in between, or the clock was set back, rows are missing too.
/// @pre the inputs have a survey and no problems
/// @throws std::runtime_error where a file cannot be written or the bag is damaged
void WriteClampMotions(const Inputs& inputs, const EngineOptions& options,
                       const std::string& folder);

}  // namespace cosserat_cable
