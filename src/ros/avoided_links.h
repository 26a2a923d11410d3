// What cables are to keep clear of must be there.
#pragma once

#include <string>

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/vehicle/vehicle_model.h"

namespace cosserat_cable {

/// Reports each link in `avoid` whose entry in the URDF has no collision geometry, or no visual
/// geometry where that is asked for: a clearance from it would always hold. Links that the vehicle
/// does not have are another check's. `urdf`: the vehicle's file.
void CheckAvoidedLinks(const CableFile& file, const VehicleModel& vehicle, const std::string& urdf,
                       Problems* problems);

}  // namespace cosserat_cable
