#include "node_sink.h"

#include <ros/console.h>
#include <ros/init.h>

#include "cosserat_cable/ros/conversions.h"
#include "diagnostics.h"

namespace cosserat_cable {
namespace {

using diagnostic_msgs::DiagnosticStatus;

// Without a message of the engine's, the node's own state is published this often [s].
constexpr double kReportPeriod = 1;
// Transforms that stop for less are a gap of the motion, which the telemetry marks [s].
constexpr double kHeldAfter = 1;
// A recording with a gap in each second would fill the console otherwise [lines].
constexpr std::size_t kMostSaid = 10;

double SecondsSince(NodeSink::Clock::time_point time) {
  return std::chrono::duration<double>(NodeSink::Clock::now() - time).count();
}

}  // namespace

void NodeSink::Telemetry(const std::string& cable, const ApexTelemetry& message) {
  pace_.Delivered((ros::Time::now() - message.header.stamp).toSec(), Clock::now());
  if (cables_[cable].held != static_cast<bool>(message.held))
    SayHeld(cable, message.held, message.header.stamp);
  // Nothing leaves any more once ROS has shut down.
  if (ros::ok()) ++telemetry_count_;
  TopicSink::Telemetry(cable, message);
}

void NodeSink::SayHeld(const std::string& cable, bool held, const ros::Time& stamp) {
  Cable& known = cables_[cable];
  known.held = held;
  if (known.said >= kMostSaid) return;
  ROS_WARN_STREAM("cable '" << cable << "' "
                            << (held ? "is held at " : "has resumed its motion at ")
                            << StampText(ToNanoseconds(stamp))
                            << (held ? ": its clamps' transforms have a gap there" : ""));
  if (++known.said == kMostSaid)
    ROS_WARN_STREAM("cable '" << cable << "': further gaps are counted in /diagnostics only");
}

void NodeSink::Diagnostics(const diagnostic_msgs::DiagnosticArray& message) {
  const double latency = (ros::Time::now() - message.header.stamp).toSec();
  pace_.Reached(ToNanoseconds(message.header.stamp), Clock::now());
  const Pace::Report pace = pace_.Take();
  diagnostic_msgs::DiagnosticArray extended = message;
  // The engine has something to tell: it runs, whatever was the last that was said.
  DiagnosticStatus status = Status(State::kRunning);
  AddValue("latency [s]", latency, &status);
  AddValue("worst latency [s]", pace.worst_latency, &status);
  AddValue("real-time factor", pace.real_time_factor, &status);
  AddValue("peak memory [bytes]", PeakMemory(), &status);
  extended.status.push_back(status);
  TopicSink::Diagnostics(extended);
  last_message_ = Clock::now();
  ROS_INFO_ONCE("cables are %.2f s behind the clock: the motion curve waits for later samples",
                latency);
}

DiagnosticStatus NodeSink::Status(State state) const {
  DiagnosticStatus status;
  status.name = "cosserat_cable: node";
  status.hardware_id = "none";
  status.level = DiagnosticStatus::WARN;
  if (state == State::kHeld) {
    status.message = "no new motion: the recording ended, or transforms stopped";
  } else if (state != State::kRunning) {
    status.message = "waiting for transforms";
  } else if (!stopped_.empty()) {
    status.level = DiagnosticStatus::ERROR;
    status.message = std::to_string(stopped_.size()) + " of " + std::to_string(cable_count_) +
                     " cables stopped; each one's status says why";
  } else if (pace_.behind()) {
    status.message = "behind the clock: markers are left out";
  } else {
    status.level = DiagnosticStatus::OK;
    status.message = "running";
  }
  return status;
}

void NodeSink::Note(const CableEngine& engine) {
  stopped_ = engine.Stopped();
  cable_count_ = engine.cable_count();
  if (pace_.behind() != was_behind_) {
    ROS_WARN_STREAM((was_behind_ ? "on time again: markers are back"
                                 : "cannot keep up with the clock: markers are left out"));
    was_behind_ = pace_.behind();
  }
  const bool moved = engine.started() && engine.now() != simulated_;
  if (engine.started()) simulated_ = engine.now();
  const State before = state_;
  if (moved) {
    last_motion_ = Clock::now();
    state_ = State::kRunning;
  } else if (!engine.started()) {
    state_ = State::kWaiting;
  } else if (SecondsSince(last_motion_) > kHeldAfter) {
    state_ = State::kHeld;
  }
  if (state_ == before) return;
  if (state_ == State::kRunning) {
    ROS_INFO_STREAM((before == State::kHeld ? "resumed at " : "running from ")
                    << StampText(simulated_));
  } else if (state_ == State::kHeld) {
    ROS_WARN_STREAM("all cables held at " << StampText(simulated_)
                                          << ": no new motion, the recording ended or transforms "
                                             "stopped");
  }
}

bool NodeSink::IsSilent() const { return SecondsSince(last_message_) > kReportPeriod; }

// Why nothing moves: `reasons` before the start; after it, that no input came. Where the clock is
// slow, the engine's own diagnostics come less often than this.
void NodeSink::Report(const std::vector<std::string>& reasons) {
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = ros::Time::now();
  DiagnosticStatus status = Status(state_);
  if (state_ == State::kHeld)
    AddValue("without new motion [s]", SecondsSince(last_motion_), &status);
  for (const std::string& reason : reasons) AddValue("missing", reason, &status);
  if (state_ == State::kWaiting && reasons != said_reasons_) {
    said_reasons_ = reasons;
    for (std::size_t i = 0; i < reasons.size() && i < kMostSaid; ++i)
      ROS_WARN_STREAM("waiting: " << reasons[i]);
    if (reasons.size() > kMostSaid)
      ROS_WARN_STREAM("waiting: " << reasons.size() - kMostSaid << " more reasons in /diagnostics");
  }
  message.status.push_back(status);
  TopicSink::Diagnostics(message);
  last_message_ = Clock::now();
}

}  // namespace cosserat_cable
