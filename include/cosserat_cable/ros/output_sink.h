// Where the engine's messages go: to topics where it runs live, into a bag in replay.
#pragma once

#include <cosserat_cable/ApexTelemetry.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

namespace cosserat_cable {

/// Every message is stamped with simulated time; MarkerArrays by their first marker.
class OutputSink {
 public:
  virtual ~OutputSink() = default;
  virtual void Telemetry(const std::string& cable, const ApexTelemetry& message) = 0;
  virtual void Markers(const std::string& cable,
                       const visualization_msgs::MarkerArray& message) = 0;
  virtual void Diagnostics(const diagnostic_msgs::DiagnosticArray& message) = 0;
};

}  // namespace cosserat_cable
