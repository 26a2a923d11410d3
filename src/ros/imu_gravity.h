// Which way is down, by the accelerometers of a recording.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/ros/cable_engine.h"
#include "cosserat_cable/ros/inputs.h"

namespace cosserat_cable {

/// A sentence for each sensor_msgs/Imu topic whose mean over the recording's beginning contradicts
/// the gravity of `options`, or whose frame cannot be followed from `survey.world`.
std::vector<std::string> ImuGravityHints(const std::vector<std::string>& paths,
                                         const BagReader& bags, const VehicleModel& vehicle,
                                         const BagSurvey& survey, const EngineOptions& options);

}  // namespace cosserat_cable
