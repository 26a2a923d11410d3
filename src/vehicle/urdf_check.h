// What is wrong with a URDF, with the lines where it is written: the parser knows neither lines nor
// more than the first mistake.
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// What cables use of a robot, as names of links.
struct UrdfUse {
  std::vector<std::string> collision_links, visual_links;  ///< whose geometry they may touch
  std::optional<std::vector<std::string>> moving_links;    ///< they follow; nothing: any
};

/// Checks the robot's links and joints: that urdfdom can read them, and that what is used is not
/// nonsense. `path` names the file. `warnings`: what contradicts itself and is read all the same;
/// `notes`: what counts for nothing, although it is used.
void CheckUrdf(const tinyxml2::XMLElement& robot, const std::string& path, const UrdfUse& use,
               Problems* problems, Problems* warnings, Problems* notes);

/// The `name` attribute, or "" where there is none.
std::string NameOf(const tinyxml2::XMLElement& element);

}  // namespace cosserat_cable
