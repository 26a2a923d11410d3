// The command-line options that more than one tool has.
#pragma once

#include "cosserat_cable/ros/inputs.h"
#include "parse_arguments.h"

namespace cosserat_cable {

/// Which names recordings use, which way is down, and which frame is at rest.
inline void AddSharedArguments(CLI::App* app, EngineOptions* engine) {
  app->add_option_function<std::string>(
      "--gravity", [engine](const std::string& text) { engine->gravity = text; },
      "\"X,Y,Z\" in the inertial frame [m/s^2]; default: 0,0,-9.81; 0,0,9.81 where z "
      "points down");
  app->add_option(
      "--world-frame", engine->links.world_frame,
      "inertial frame; default: the topmost recorded one that no localisation corrects");
  app->add_option("--joint-states", engine->links.topics.joint_states, "topic of joint states")
      ->capture_default_str();
  app->add_option("--tf", engine->links.topics.tf,
                  "topic of transforms; static ones: the same with _static behind it")
      ->capture_default_str();
  app->add_option("--tf-prefix", engine->links.tf_prefix,
                  "what recorded frames and joints have before the URDF's names: rover1 for "
                  "rover1/base_link");
  app->add_flag("--use-record-times", engine->links.topics.use_record_times,
                "take the times at which messages were recorded instead of all their stamps; "
                "copies in the output are stamped so");
  app->add_option("--hold", engine->links.held_joints,
                  "joint(s) that stay at rest because nothing drives them: at zero, or at the end "
                  "of their limits that is nearest to it");
  app->add_option("--max-gap", engine->links.max_gap,
                  "samples farther apart are not interpolated: the pose is held [s]")
      ->capture_default_str();
  app->add_option("--smooth", engine->links.smooth,
                  "low-pass of the links' motion, without delay [Hz]; 0: none")
      ->capture_default_str();
}

inline void AddInputArguments(CLI::App* app, InputPaths* paths, EngineOptions* engine) {
  app->add_option("--vehicle", paths->vehicle, "URDF file of the vehicle")
      ->required()
      ->check(FilledPath());
  app->add_option("--cables", paths->cables, "YAML file of its cables")
      ->required()
      ->check(FilledPath());
  app->add_option(
         "--section", paths->sections,
         "[NAME=]FILE, may be repeated: the cable NAME, or all, have the stiffness, damping "
         "and extensions of a specimen's file, as cable_identify and cable_diagnose write it")
      ->allow_extra_args(false)
      ->check(FilledPath());
  app->add_option("--bag", paths->bags, "recording(s) with /tf, /tf_static, /joint_states")
      ->check(FilledPath());
  app->add_option("--start", paths->start, "begin so long after the recording's begin [s]");
  app->add_option("--duration", paths->duration, "replay so much of it [s]; default: to its end");
  AddSharedArguments(app, engine);
}

}  // namespace cosserat_cable
