// How cables' clamps move to one another through a whole recording, without simulating anything.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cosserat_cable/ros/bag_reader.h"
#include "cosserat_cable/ros/cable_engine.h"
#include "cosserat_cable/vehicle/clamp_judge.h"

namespace cosserat_cable {

/// Hands a recorded message on.
void Feed(const BagMessage& message, LinkMotion* links);

/// Told of where a cable's clamps are at an instant [ns].
using ClampObserver =
    std::function<void(std::size_t cable, std::int64_t time, const Pose& X_WA, const Pose& X_WB)>;

/// The clamps of each cable at the instants of telemetry, as a run judges them. `from`, `to`: times
/// of recording [ns].
std::vector<ClampJudge> FollowClamps(const BagReader& bags, std::int64_t from, std::int64_t to,
                                     const VehicleModel& vehicle,
                                     const std::vector<CableModel>& cables,
                                     const EngineOptions& options,
                                     const ClampObserver& observer = nullptr);

}  // namespace cosserat_cable
