// The last good state of a cable that failed, for whoever has to find out why.
#pragma once

#include <cstdint>
#include <string>

#include "cosserat_cable/cable/cable_simulation.h"

namespace cosserat_cable {

/// Writes YAML: what happened, the clamps' poses that could not be followed, and all nodes. False
/// where the file could not be written.
bool DumpState(const std::string& path, const CableSimulation& cable, const Surroundings& then,
               std::int64_t time, const std::string& world_frame, const Eigen::Vector3d& gravity_W,
               const std::string& message);

}  // namespace cosserat_cable
