// Whether what a set says of a cable is whole and goes together.
#pragma once

#include <vector>

#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Checks as for a simulation, but damping may be unknown.
/// @param keys the set's cable with the experiment's specimen before it
void CheckSpecimen(CableKeys keys, const SourceMark& cable, Problems* problems);

/// Reports laws of clamp b in a set whose experiments all leave end b without a clamp.
void CheckClampLaws(const CableKeys& keys, const std::vector<Experiment>& experiments,
                    Problems* problems);

/// Reports keys that say nothing in a measurement set.
void RefuseVehicleKeys(const CableKeys& keys, Problems* problems);

}  // namespace cosserat_cable
