// The state of a cable that failed: all that it takes to fail in the same way again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_simulation.h"

namespace cosserat_cable {

struct StateDump {
  enum class Failed {
    kSettling,  ///< there is no state: the cable finds no rest at `then`
    kStep,      ///< from `state` to `then`
    kState      ///< `state` itself is not finite
  };

  Failed failed = Failed::kStep;
  std::string message;     ///< why
  CableFile cable;         ///< one
  std::int64_t stamp = 0;  ///< where the step began [ns]
  std::string world_frame;
  Eigen::Vector3d gravity_W;           ///< [m/s^2]
  std::string vehicle_file;            ///< whose bodies it avoids; may be empty
  std::vector<std::string> obstacles;  ///< links of those, in the simulation's order
  double dt = 0;                       ///< [s]
  Surroundings then;
  std::vector<double> state;  ///< CableSimulation::State
  std::vector<Pose> nodes;    ///< in that state; not read
};

/// Writes YAML: numbers that have to be the same to the last bit in hexadecimal, as IEEE 754 has
/// them, and beside them poses for the eye. False where the file could not be written.
bool WriteStateDump(const std::string& path, const StateDump& dump);

/// What is wrong goes to `problems`; where it grew, the result is not to be used.
StateDump ReadStateDump(const std::string& path, Problems* problems);

/// What the failed one is said to be: of a settling or a step the outcome of doing it again.
/// @param bodies those that the cable avoids, in the order of `obstacles`
/// @return the message of the failure; empty where it does not fail any more
std::string FailAgain(const StateDump& dump, const std::vector<const Body*>& bodies,
                      Problems* problems);

/// As a failure is told: "no equilibrium at the start: ...".
std::string SettlingFailure(const StepOutcome& outcome);
inline constexpr const char* kNotFinite = "its state is not finite";

}  // namespace cosserat_cable
