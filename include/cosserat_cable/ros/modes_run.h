// The natural modes of a vehicle's cables at rest, or of a specimen between two clamps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/console/exit_code.h"
#include "cosserat_cable/ros/cable_engine.h"

namespace cosserat_cable {

struct ModesOptions {
  std::string cables;                 ///< YAML
  std::vector<std::string> sections;  ///< as InputPaths has them
  std::string vehicle;                ///< URDF; empty for a specimen
  std::string a, b;                   ///< a specimen's clamps, "x, y, z, qx, qy, qz, qw" [m]
  std::vector<std::string> joints;    ///< "NAME=VALUE,..."; others are at rest, see RestPosition
  std::vector<std::string> bags;      ///< instead: where the vehicle is at `time` of a recording
  std::optional<double> time;         ///< after its first sample [s]
  EngineOptions engine;               ///< gravity, and how the recording is read
  int count = 6;                      ///< modes of each cable
  std::string output;  ///< folder for modes.json, shapes and the configuration; may be empty
  std::string json;    ///< file for the numbers; may be empty
};

/// Settles each cable and prints its modes. Gravity is in the vehicle's root, or in the
/// recording's inertial frame. Reports problems to stderr.
ExitCode RunModes(ModesOptions options);

}  // namespace cosserat_cable
