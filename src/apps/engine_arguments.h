// The command-line options that more than one tool has.
#pragma once

#include "cosserat_cable/ros/inputs.h"
#include "parse_arguments.h"

namespace cosserat_cable {

inline void AddInputArguments(CLI::App* app, InputPaths* paths, EngineOptions* engine) {
  app->add_option("--vehicle", paths->vehicle, "URDF file of the vehicle")->required();
  app->add_option("--cables", paths->cables, "YAML file of its cables")->required();
  app->add_option("--bag", paths->bags, "recording(s) with /tf, /tf_static, /joint_states");
  app->add_option("--start", paths->start, "begin so long after the recording's begin [s]");
  app->add_option("--duration", paths->duration, "replay so much of it [s]; default: to its end");
  app->add_option(
      "--world-frame", engine->links.world_frame,
      "inertial frame; default: the topmost recorded one that no localisation corrects");
  app->add_option("--hold", engine->links.held_joints,
                  "joint(s) that stay at position zero because nothing drives them");
  app->add_option("--max-gap", engine->links.max_gap,
                  "samples farther apart are not interpolated: the pose is held [s]")
      ->capture_default_str();
  app->add_option("--smooth", engine->links.smooth,
                  "low-pass of the links' motion, without delay [Hz]; 0: none")
      ->capture_default_str();
}

}  // namespace cosserat_cable
