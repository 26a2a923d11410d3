// Another program, run to its end.
#pragma once

#include <string>
#include <vector>

namespace cosserat_cable {

/// Runs a program, found as a shell finds it, and waits for it. @return whether it ended with 0
bool RunProgram(const std::vector<std::string>& arguments);

}  // namespace cosserat_cable
