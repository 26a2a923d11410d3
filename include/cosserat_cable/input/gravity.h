// Gravity as users write it, and as it is said to them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// The default, for frames whose z axis points up, as REP-103 has them [m/s^2].
inline const Eigen::Vector3d kGravityDown{0, 0, -9.81};

/// Reads "X,Y,Z" [m/s^2]. What is wrong is a problem under the key `gravity`, and nothing is
/// returned: not three numbers, one that is not finite, or a size that no vehicle meets. Zero is
/// fine.
std::optional<Eigen::Vector3d> ReadGravity(const std::string& text, Problems* problems);
/// The same of numbers.
std::optional<Eigen::Vector3d> ReadGravity(const std::vector<double>& values, Problems* problems);

/// "gravity 9.81 m/s^2 along -z of odom", "no gravity".
std::string GravityText(const Eigen::Vector3d& gravity, const std::string& frame);

/// The value of an option: "0,0,9.81".
std::string GravityOption(const Eigen::Vector3d& gravity);

/// Whether a frame's name says that its z axis points down (NED, FRD, z_down) or up (ENU, FLU,
/// NWU).
enum class VerticalAxis { kUnknown, kUp, kDown };
VerticalAxis VerticalAxisOf(const std::string& frame);

/// A sentence where the frame's name contradicts gravity, with the option that would fit; or "".
std::string GravityHint(const Eigen::Vector3d& gravity, const std::string& frame);

/// The same of what accelerometers felt on the whole, in the inertial frame [m/s^2]; `source` names
/// them. Nothing is said of a vector that may be without gravity, or where gravity is off on
/// request.
std::string GravityHint(const Eigen::Vector3d& gravity, const std::string& frame,
                        const Eigen::Vector3d& felt_W, const std::string& source);

}  // namespace cosserat_cable
