// The live node.
#include "cosserat_cable/ros/cable_node.h"

#include <ros/init.h>
#include <ros/master.h>

#include <cstdio>
#include <iostream>
#include <string>
#include <utility>

#include "cosserat_cable/console/run_tool.h"

namespace {

constexpr char kHelp[] =
    "cable_node: simulates the cables of a vehicle live, as launch/replay.launch starts it.\n"
    "Private parameters: ~vehicle (URDF file; default: robot_description), ~cables (YAML file),\n"
    "~use_joint_states, ~world_frame, ~hold_joints, ~max_gap, ~smooth, ~dt, ~telemetry_rate,\n"
    "~marker_rate, ~amplitude_window, ~threads, ~json, ~gravity (\"X,Y,Z\" in the inertial frame\n"
    "[m/s^2]), ~joint_states and ~tf (topics), ~tf_prefix, ~use_record_times (times of arrival,\n"
    "not stamps), ~settle_again (a cable that stopped does so after so long [s]; 0: never).\n"
    "Topics: cables/NAME/apex, cables/NAME/markers, cables/markers, /diagnostics.\n";

int Run(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--help" || std::string(argv[i]) == "-h") {
      std::cout << kHelp;
      return 0;
    }
  }
  // Lines at once, also through a pipe.
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  ros::init(argc, argv, "cable_node", ros::init_options::NoSigintHandler);
  if (!ros::master::check())
    std::cerr << "waiting for the ROS master at " << ros::master::getURI() << std::endl;
  // With the last handle ROS shuts down, and all that is said after that is lost.
  const ros::NodeHandle node;
  cosserat_cable::Problems problems;
  const cosserat_cable::NodeOptions options =
      cosserat_cable::ReadNodeOptions(ros::NodeHandle("~"), &problems);
  return cosserat_cable::RunNode(options, std::move(problems));
}

}  // namespace

int main(int argc, char** argv) {
  return cosserat_cable::RunTool([&] { return Run(argc, argv); });
}
