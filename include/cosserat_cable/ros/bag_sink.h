// The engine's messages in a bag, between the motion's messages copied from the input, in the order
// of time.
#pragma once

#include <deque>
#include <string>
#include <unordered_map>

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
  /// The one of that topic; made where there is none yet.
  template <typename T>
  BagWriter::Connection ConnectionOf(const std::string& topic);

  BagWriter* writer_;
  std::int64_t begin_;
  std::unordered_map<std::string, BagWriter::Connection> own_;  // by topic
  std::unordered_map<const ros::M_string*, BagWriter::Connection> copied_;
  std::deque<BagMessage> copies_;  // read ahead of the simulation
};

}  // namespace cosserat_cable
