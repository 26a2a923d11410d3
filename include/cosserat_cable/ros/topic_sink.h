// The engine's messages on topics.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <map>
#include <string>
#include <vector>

#include "cosserat_cable/ros/output_sink.h"

namespace cosserat_cable {

/// cables/NAME/apex and cables/NAME/markers for each cable, cables/markers with all of them (rviz
/// knows no wildcard), and /diagnostics.
class TopicSink : public OutputSink {
 public:
  TopicSink(ros::NodeHandle* node, const std::vector<std::string>& cables);

  void Telemetry(const std::string& cable, const ApexTelemetry& message) override;
  void Markers(const std::string& cable, const visualization_msgs::MarkerArray& message) override;
  void Diagnostics(const diagnostic_msgs::DiagnosticArray& message) override;

 private:
  std::map<std::string, ros::Publisher> apex_, markers_;
  ros::Publisher all_markers_, diagnostics_;
};

}  // namespace cosserat_cable
