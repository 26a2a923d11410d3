#include "cosserat_cable/ros/topic_sink.h"

namespace cosserat_cable {
namespace {

// A late link makes the simulation catch up in one go: no sample of that is to be dropped
// [messages].
constexpr std::uint32_t kTelemetryQueue = 10'000;
// A viewer that is behind wants the newest.
constexpr std::uint32_t kMarkerQueue = 100;

}  // namespace

TopicSink::TopicSink(ros::NodeHandle* node, const std::vector<std::string>& cables) {
  for (const std::string& cable : cables) {
    apex_[cable] = node->advertise<ApexTelemetry>("cables/" + cable + "/apex", kTelemetryQueue);
    markers_[cable] = node->advertise<visualization_msgs::MarkerArray>(
        "cables/" + cable + "/markers", kMarkerQueue);
  }
  all_markers_ = node->advertise<visualization_msgs::MarkerArray>("cables/markers", kMarkerQueue);
  diagnostics_ = node->advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", kMarkerQueue);
}

void TopicSink::Telemetry(const std::string& cable, const ApexTelemetry& message) {
  apex_.at(cable).publish(message);
}

void TopicSink::Markers(const std::string& cable, const visualization_msgs::MarkerArray& message) {
  markers_.at(cable).publish(message);
  all_markers_.publish(message);
}

void TopicSink::Diagnostics(const diagnostic_msgs::DiagnosticArray& message) {
  diagnostics_.publish(message);
}

}  // namespace cosserat_cable
