// Last stage of a record: what a sensor makes of what a channel truly shows.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cosserat_cable/cable/faults.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Of one channel, all the groups that it is in one behind the other.
struct ChannelSensor {
  /// What the channel shows of a vector, where the sensor is tilted: R(tilt)' e_axis. All three
  /// components count, whether or not the record has them.
  std::optional<Eigen::Vector3d> direction;
  double scale = 1;
  std::vector<double> low_passes;  ///< time constants [s]
};

/// By channel.
std::vector<ChannelSensor> SensorsOf(const std::vector<Channel>& channels, const Faults& faults);

}  // namespace cosserat_cable
