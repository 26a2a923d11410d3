// The engine's messages in a bag, between the motion's messages copied from the input, in the order
// of time.
#pragma once

#include <deque>
#include <string>

#include "cosserat_cable/ros/bag_reader.h"
#include "cosserat_cable/ros/bag_writer.h"
#include "cosserat_cable/ros/output_sink.h"

namespace cosserat_cable {

/// Throws BagWriteError as BagWriter does.
class BagSink : public OutputSink {
 public:
  /// `writer` outlives this. Copies from before `begin` [ns] (/tf_static) are written at that time.
  BagSink(BagWriter* writer, std::int64_t begin) : writer_(writer), begin_(begin) {}

  void Copy(BagMessage message);
  /// Writes the copies that still wait.
  void Flush();

  void Telemetry(const std::string& cable, const ApexTelemetry& message) override;
  void Markers(const std::string& cable, const visualization_msgs::MarkerArray& message) override;
  void Diagnostics(const diagnostic_msgs::DiagnosticArray& message) override;

 private:
  void WriteCopiesUntil(std::int64_t time);
  void WriteFirstCopy();

  BagWriter* writer_;
  std::int64_t begin_;
  std::deque<BagMessage> copies_;  // read ahead of the simulation
};

}  // namespace cosserat_cable
