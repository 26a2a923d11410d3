// A measurement set simulated with a cable: what the tool cable_simulate does.
#pragma once

#include <string>

#include "cosserat_cable/console/exit_code.h"

namespace cosserat_cable {

struct SimulateRunOptions {
  std::string set;
  std::string cable;   ///< YAML; empty: the set's own
  std::string output;  ///< folder
  double dt = 5e-4;    ///< [s]
  int elements = 0;    ///< 0: as the cable says
  bool plain = false;  ///< no comparison with coarser steps
  bool rms = false;    ///< compare with the records
  std::string json;
};

/// Writes a CSV per experiment with the record's own columns and times. Reports problems to stderr.
ExitCode RunSimulate(const SimulateRunOptions& options);

}  // namespace cosserat_cable
