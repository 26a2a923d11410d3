// What is wrong with a URDF, with the lines where it is written: the parser knows neither lines nor
// more than the first mistake.
#pragma once

#include <tinyxml2.h>

#include <string>

#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// Checks the robot's links and joints. `path` names the file in `problems`.
void CheckUrdf(const tinyxml2::XMLElement& robot, const std::string& path, Problems* problems);

/// The `name` attribute, or "" where there is none.
std::string NameOf(const tinyxml2::XMLElement& element);

}  // namespace cosserat_cable
