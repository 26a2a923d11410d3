#include "cosserat_cable/ros/bag_sink.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

// While a link's samples are missing the simulation waits and copies pile up; more than this are
// written ahead of their turn, which a bag allows.
constexpr std::size_t kMaxWaiting = 20'000;

}  // namespace

void BagSink::Copy(BagMessage message) {
  message.time = std::max(message.time, begin_);
  copies_.push_back(std::move(message));
  if (copies_.size() > kMaxWaiting) WriteFirstCopy();
}

void BagSink::WriteFirstCopy() {
  const BagMessage& message = copies_.front();
  const auto [entry, is_new] = copied_.try_emplace(message.connection.get());
  if (is_new) entry->second = writer_->Connect(message.topic, *message.connection);
  writer_->Write(entry->second, ToRosTime(message.time), message.bytes);
  copies_.pop_front();
}

template <typename T>
BagWriter::Connection BagSink::ConnectionOf(const std::string& topic) {
  const auto [entry, is_new] = own_.try_emplace(topic);
  if (is_new) entry->second = writer_->Connect<T>(topic);
  return entry->second;
}

void BagSink::WriteCopiesUntil(std::int64_t time) {
  while (!copies_.empty() && copies_.front().time <= time) WriteFirstCopy();
}

void BagSink::Flush() { WriteCopiesUntil(std::numeric_limits<std::int64_t>::max()); }

void BagSink::Telemetry(const std::string& cable, const ApexTelemetry& message) {
  WriteCopiesUntil(ToNanoseconds(message.header.stamp));
  writer_->Write(ConnectionOf<ApexTelemetry>("/cables/" + cable + "/apex"), message.header.stamp,
                 message);
}

void BagSink::Markers(const std::string& cable, const visualization_msgs::MarkerArray& message) {
  const ros::Time stamp = message.markers.front().header.stamp;
  WriteCopiesUntil(ToNanoseconds(stamp));
  writer_->Write(ConnectionOf<visualization_msgs::MarkerArray>("/cables/" + cable + "/markers"),
                 stamp, message);
}

void BagSink::Diagnostics(const diagnostic_msgs::DiagnosticArray& message) {
  WriteCopiesUntil(ToNanoseconds(message.header.stamp));
  writer_->Write(ConnectionOf<diagnostic_msgs::DiagnosticArray>("/diagnostics"),
                 message.header.stamp, message);
}

}  // namespace cosserat_cable
