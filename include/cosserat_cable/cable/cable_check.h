// What can be said of cables once the vehicle is known; it needs no vehicle, only its names and
// distances.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// Every link that a cable names (a, b, reference, avoid) is one of the vehicle's; others are
/// problems at the line that names them, with the nearest link. A cable without links (a specimen)
/// cannot be hung into a vehicle and is a problem too.
void CheckAgainstVehicle(const CableFile& file, const std::vector<std::string>& link_names,
                         Problems* problems);

/// Reports clamps that are farther apart than the cable can bridge: its length and 1 % of stretch.
/// @param distance between the clamps' origins [m]; for clamps on links that move, at one instant
void CheckClampDistance(const CableModel& cable, const CableMarks& marks, double distance,
                        Problems* problems);

/// How deep an extension's obstacle holds the clamps at these poses, deeper than the cable is
/// thick, and what to do: "clamp a is 12.0 mm inside the plane of `contact`, ..."; "" where it does
/// not.
std::string ClampsInside(const CableModel& cable, const Pose& X_WA, const Pose& X_WB);

}  // namespace cosserat_cable
