// Whether what a set says of a cable is whole and goes together.
#pragma once

#include "cosserat_cable/cable/cable_keys.h"

namespace cosserat_cable {

/// Checks as for a simulation, but damping may be unknown.
/// @param keys the set's cable with the experiment's specimen before it
void CheckSpecimen(CableKeys keys, const SourceMark& cable, Problems* problems);

/// Reports keys that say nothing in a measurement set.
void RefuseVehicleKeys(const CableKeys& keys, Problems* problems);

}  // namespace cosserat_cable
