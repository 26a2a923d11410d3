// Where ROS packages lie, without ROS: what "package://NAME/..." in a URDF points to.
#pragma once

#include <functional>
#include <string>

namespace cosserat_cable {

/// Turns "package://NAME" into a folder; returns "" for an unknown package.
using PackageFinder = std::function<std::string(const std::string& package)>;

/// Looks for the folder whose package.xml has that <name>: `start` and its parents first, then the
/// entries of $ROS_PACKAGE_PATH (at the time of this call) with their subfolders up to two levels
/// down.
PackageFinder FindPackagesFrom(const std::string& start);

}  // namespace cosserat_cable
