// A cable's report as its telemetry message: in the axes of the reference link and as seen from it.
#pragma once

#include <cosserat_cable/ApexTelemetry.h>

#include <cstdint>

#include "cosserat_cable/cable/cable_simulation.h"

namespace cosserat_cable {

/// Everything but frame_id, amplitude and held.
/// @param reference motion of the reference link R in the world
/// @param rest_R the apex's position at rest, in R [m]
ApexTelemetry MakeTelemetry(const CableReport& report, const Motion& reference,
                            const Eigen::Vector3d& rest_R, std::int64_t time);

/// No value is NaN, and only `clearance` may be infinite.
bool IsValid(const ApexTelemetry& message);

}  // namespace cosserat_cable
