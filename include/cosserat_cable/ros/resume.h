// The failure of a cable once more, from the state that was written when it failed.
#pragma once

#include <string>

#include "cosserat_cable/console/exit_code.h"

namespace cosserat_cable {

/// Repeats what failed and tells whether it fails in the same way: kExitFailed where it does,
/// kExitDone where it does not fail, or otherwise. `vehicle`: the URDF whose links the cable
/// avoids; empty: the one that the run had.
ExitCode ResumeDump(const std::string& dump, const std::string& vehicle);

}  // namespace cosserat_cable
