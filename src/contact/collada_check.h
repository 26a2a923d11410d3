// Whether a COLLADA file can be followed: assimp walks down its nodes without asking how deep.
#pragma once

#include <string>

namespace cosserat_cable {

/// What keeps the text of a COLLADA file from being read: elements within more than some hundred
/// others, or nodes that are instances of each other in a circle. Empty where nothing does.
std::string ColladaProblem(const std::string& text);

}  // namespace cosserat_cable
