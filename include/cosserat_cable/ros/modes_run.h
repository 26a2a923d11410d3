// The natural modes of a vehicle's cables at rest, or of a specimen between two clamps.
#pragma once

#include <string>

#include "cosserat_cable/console/exit_code.h"

namespace cosserat_cable {

struct ModesOptions {
  std::string cables;   ///< YAML
  std::string vehicle;  ///< URDF; empty for a specimen
  std::string a, b;     ///< a specimen's clamps, "x, y, z, qx, qy, qz, qw", z axis up [m]
  int count = 6;        ///< modes of each cable
  std::string output;   ///< folder for modes.json, shapes and the configuration; may be empty
  std::string json;     ///< file for the numbers; may be empty
};

/// Settles each cable, with the vehicle's joints at zero and gravity along -z of its root, and
/// prints its modes. Reports problems to stderr.
ExitCode RunModes(const ModesOptions& options);

}  // namespace cosserat_cable
