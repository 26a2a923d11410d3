// Whether the lists and texts that a serialized message claims to have are within its bytes.
#pragma once

#include <cstdint>
#include <vector>

namespace cosserat_cable {

/// For sensor_msgs::JointState and tf2_msgs::TFMessage.
template <typename Message>
bool HoldsWhole(const std::vector<std::uint8_t>& bytes);

}  // namespace cosserat_cable
