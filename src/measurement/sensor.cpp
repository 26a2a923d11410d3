#include "sensor.h"

#include <algorithm>

#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {

std::vector<ChannelSensor> SensorsOf(const std::vector<Channel>& channels, const Faults& faults) {
  std::vector<ChannelSensor> sensors;
  for (const Channel& channel : channels) {
    ChannelSensor sensor;
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    for (const SensorFault& fault : faults.sensor) {
      const bool in_group =
          fault.channels.empty() ||
          std::count(fault.channels.begin(), fault.channels.end(), channel.column) > 0;
      if (!in_group) continue;
      sensor.scale *= fault.scale;
      if (fault.low_pass > 0) sensor.low_passes.push_back(fault.low_pass);
      if (fault.tilt.isZero(0)) continue;
      turn = RotationExp(fault.tilt) * turn;
      sensor.direction = turn.conjugate() * Eigen::Vector3d::Unit(channel.axis);
    }
    sensors.push_back(sensor);
  }
  return sensors;
}

}  // namespace cosserat_cable
