// The live node: transforms in, swaying cables out.
//
// A cable at time t needs the samples on both sides of t (math/pose_curve.h): what is published is
// older than the newest transform by some ten sample periods. The node measures this latency and
// says it in /diagnostics.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <memory>
#include <string>

#include "cosserat_cable/console/exit_code.h"
#include "cosserat_cable/ros/cable_engine.h"
#include "cosserat_cable/ros/inputs.h"
#include "cosserat_cable/ros/topic_sink.h"

namespace cosserat_cable {

struct NodeOptions {
  InputPaths inputs;  ///< no bags
  EngineOptions engine;
  bool use_joint_states = false;  ///< take /joint_states through the URDF besides /tf
  std::string json;               ///< the summary at the end; may be empty
};

/// Reads the node's parameters; each that is missing or of a wrong type is a problem.
NodeOptions ReadNodeOptions(const ros::NodeHandle& parameters, Problems* problems);

/// Runs until ROS shuts down, or SIGINT or SIGTERM comes. `problems`: of the options; where there
/// are any, of these or of the input, all are listed and nothing runs.
ExitCode RunNode(const NodeOptions& options, Problems problems);

}  // namespace cosserat_cable
