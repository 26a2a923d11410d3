// The command-line options that more than one tool has.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cosserat_cable/ros/inputs.h"

namespace cosserat_cable {

inline void AddInputArguments(CLI::App* app, InputPaths* paths, EngineOptions* engine) {
  app->add_option("--vehicle", paths->vehicle, "URDF file of the vehicle")->required();
  app->add_option("--cables", paths->cables, "YAML file of its cables")->required();
  app->add_option("--bag", paths->bags, "recording(s) with /tf, /tf_static, /joint_states");
  app->add_option("--start", paths->start, "begin so long after the recording's begin [s]");
  app->add_option("--duration", paths->duration, "replay so much of it [s]; default: to its end");
  app->add_option("--world-frame", engine->links.world_frame,
                  "inertial frame; default: the root of the recorded tree above the vehicle");
  app->add_option("--hold", engine->links.held_joints,
                  "joint(s) that stay at position zero because nothing drives them");
  app->add_option("--max-gap", engine->links.max_gap,
                  "samples farther apart are not interpolated: the pose is held [s]")
      ->capture_default_str();
}

/// Parses; false where the program is to end with `code`.
inline bool Parse(CLI::App* app, int argc, char** argv, int* code) {
  // roslaunch appends __name:=... and __log:=... to every program, also to those that need no
  // master.
  std::vector<std::string> arguments;
  for (int i = argc - 1; i > 0; --i) {  // CLI11 takes them in reverse
    const std::string argument = argv[i];
    const bool remapping = argument.rfind("__", 0) == 0 && argument.find(":=") != std::string::npos;
    if (!remapping) arguments.push_back(argument);
  }
  try {
    app->parse(arguments);
    return true;
  } catch (const CLI::ParseError& error) {
    *code = app->exit(error) == 0 ? 0 : 2;
    return false;
  }
}

}  // namespace cosserat_cable
