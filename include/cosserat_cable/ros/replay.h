// The simulation of a recording without a master: as fast as it goes, the same bytes on every run.
#pragma once

#include <string>

#include "cosserat_cable/console/exit_code.h"
#include "cosserat_cable/ros/inputs.h"

namespace cosserat_cable {

struct ReplayOptions {
  InputPaths inputs;
  std::string output;  ///< bag; "OUT.bag" has its cables' effective configuration beside it in
                       ///< "OUT.cables.yaml"
  std::string json;    ///< the summary; may be empty
  EngineOptions engine;
};

/// Reports to stdout (summary) and stderr (problems, progress).
ExitCode RunReplay(ReplayOptions options);

}  // namespace cosserat_cable
