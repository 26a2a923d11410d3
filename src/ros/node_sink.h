// What the live node publishes, and what it says of its own state: waiting, running, held, resumed.
#pragma once

#include <ros/node_handle.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cosserat_cable/ros/cable_engine.h"
#include "cosserat_cable/ros/topic_sink.h"
#include "pace.h"

namespace cosserat_cable {

/// Adds what only the live node knows to the engine's diagnostics, and watches how late it is.
class NodeSink : public TopicSink {
 public:
  using Clock = std::chrono::steady_clock;
  using TopicSink::TopicSink;

  void Telemetry(const std::string& cable, const ApexTelemetry& message) override;
  void Diagnostics(const diagnostic_msgs::DiagnosticArray& message) override;

  /// Says what has changed since it was called last; publishes the node's state where the engine
  /// had nothing to publish for a second. `reasons`: asked for where nothing moves.
  template <class Reasons>
  void Watch(const CableEngine& engine, const Reasons& reasons) {
    Note(engine);
    if (IsSilent()) Report(state_ == State::kRunning ? std::vector<std::string>() : reasons());
  }

  Pace* pace() { return &pace_; }
  std::uint64_t telemetry_count() const { return telemetry_count_; }  ///< published

 private:
  enum class State { kStarting, kWaiting, kRunning, kHeld };

  void Note(const CableEngine& engine);
  bool IsSilent() const;
  void Report(const std::vector<std::string>& reasons);
  void SayHeld(const std::string& cable, bool held, const ros::Time& stamp);
  /// The node's status, but for the values.
  diagnostic_msgs::DiagnosticStatus Status(State state) const;

  struct Cable {
    bool held = false;
    std::size_t said = 0;  // how often
  };

  Pace pace_;
  State state_ = State::kStarting;
  std::int64_t simulated_ = 0;  // [ns]
  bool was_behind_ = false;
  std::vector<std::string> stopped_;  // cables
  std::size_t cable_count_ = 0;
  std::map<std::string, Cable> cables_;
  std::vector<std::string> said_reasons_;  // why it waits
  std::uint64_t telemetry_count_ = 0;
  Clock::time_point last_message_ = Clock::now(), last_motion_ = Clock::now();
};

}  // namespace cosserat_cable
