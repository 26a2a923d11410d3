// The live node.
#include "cosserat_cable/ros/cable_node.h"

#include <ros/console.h>
#include <ros/init.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "cable_node");
  cosserat_cable::Problems problems;
  const cosserat_cable::NodeOptions options =
      cosserat_cable::ReadNodeOptions(ros::NodeHandle("~"), &problems);
  if (!problems.empty()) {
    for (const cosserat_cable::Problem& problem : problems.all()) {
      ROS_FATAL_STREAM(problem.ToString());
    }
    return cosserat_cable::kExitBadInput;
  }
  return cosserat_cable::RunNode(options);
}
