#include "cosserat_cable/ros/cable_node.h"

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/message_event.h>
#include <ros/param.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/ros/conversions.h"
#include "diagnostics.h"
#include "pace.h"

namespace cosserat_cable {
namespace {

// Bursts of `rosbag play -r 5` and the time that a slow step takes fit in [messages].
constexpr std::uint32_t kInputQueue = 20'000;
constexpr double kSpinSeconds = 0.02;
// Without news from the simulation, the reason is published this often [s].
constexpr double kWaitingPeriod = 1;

using Clock = std::chrono::steady_clock;
using TfEvent = ros::MessageEvent<const tf2_msgs::TFMessage>;
using JointEvent = ros::MessageEvent<const sensor_msgs::JointState>;

// Adds what only the live node knows to the engine's diagnostics, and watches how late it is.
class NodeSink : public TopicSink {
 public:
  using TopicSink::TopicSink;

  void Telemetry(const std::string& cable, const ApexTelemetry& message) override {
    pace_.Delivered((ros::Time::now() - message.header.stamp).toSec(), Clock::now());
    TopicSink::Telemetry(cable, message);
  }

  void Diagnostics(const diagnostic_msgs::DiagnosticArray& message) override {
    const double latency = (ros::Time::now() - message.header.stamp).toSec();
    pace_.Reached(ToNanoseconds(message.header.stamp), Clock::now());
    const Pace::Report pace = pace_.Take();
    diagnostic_msgs::DiagnosticArray extended = message;
    diagnostic_msgs::DiagnosticStatus status;
    status.name = "cosserat_cable: node";
    status.hardware_id = "none";
    status.level = pace_.behind() ? diagnostic_msgs::DiagnosticStatus::WARN
                                  : diagnostic_msgs::DiagnosticStatus::OK;
    status.message = pace_.behind() ? "behind the clock: markers are left out" : "running";
    AddValue("latency [s]", latency, &status);
    AddValue("worst latency [s]", pace.worst_latency, &status);
    AddValue("real-time factor", pace.real_time_factor, &status);
    AddValue("peak memory [bytes]", PeakMemory(), &status);
    extended.status.push_back(status);
    TopicSink::Diagnostics(extended);
    last_ = last_news_ = Clock::now();
    ROS_INFO_ONCE("cables are %.2f s behind the clock: the motion curve waits for later samples",
                  latency);
  }

  Pace* pace() { return &pace_; }
  double SecondsSinceLast() const { return SecondsSince(last_); }
  /// Why nothing moves: `reasons` before the start; after it, that no input came.
  void ReportWaiting(bool started, const std::vector<std::string>& reasons) {
    diagnostic_msgs::DiagnosticArray message;
    message.header.stamp = ros::Time::now();
    diagnostic_msgs::DiagnosticStatus status;
    status.name = "cosserat_cable: node";
    status.hardware_id = "none";
    status.level = diagnostic_msgs::DiagnosticStatus::WARN;
    status.message = started ? "no new motion: the recording ended, or transforms stopped"
                             : "waiting for transforms";
    if (started) AddValue("without new motion [s]", SecondsSince(last_news_), &status);
    for (const std::string& reason : reasons) AddValue("missing", reason, &status);
    message.status.push_back(status);
    TopicSink::Diagnostics(message);
    last_ = Clock::now();
  }

 private:
  static double SecondsSince(Clock::time_point time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
  }

  Pace pace_;
  Clock::time_point last_ = Clock::now();       // message
  Clock::time_point last_news_ = Clock::now();  // from the simulation
};

// The parameter robot_description as a file, for the one reader of vehicles; removed at the end.
class DescriptionFile {
 public:
  explicit DescriptionFile(const std::string& text) {
    const char* folder = std::getenv("TMPDIR");
    path_ = std::string(folder != nullptr ? folder : "/tmp") + "/robot_description_XXXXXX";
    const int descriptor = mkstemp(path_.data());
    if (descriptor >= 0) close(descriptor);
    WriteTextFile(path_, text);
  }
  ~DescriptionFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

Inputs LoadNodeInputs(const NodeOptions& options, Problems* problems) {
  if (!options.inputs.vehicle.empty()) return LoadInputs(options.inputs, options.engine, problems);
  std::string description;
  if (!ros::param::get("robot_description", description)) {
    problems->Add("", 0, "vehicle",
                  "neither the parameter ~vehicle (a URDF file) nor robot_description is set");
    return {};
  }
  const DescriptionFile file(description);
  InputPaths paths = options.inputs;
  paths.vehicle = file.path();
  return LoadInputs(paths, options.engine, problems);
}

// With the time of arrival, which is as near to that of recording as a live node comes.
tf2_msgs::TFMessage Restamped(tf2_msgs::TFMessage message) {
  for (auto& transform : message.transforms) transform.header.stamp = ros::Time::now();
  return message;
}

sensor_msgs::JointState Restamped(sensor_msgs::JointState message) {
  message.header.stamp = ros::Time::now();
  return message;
}

std::int64_t Arrival() { return ToNanoseconds(ros::Time::now()); }

// What is published under other names than those to which the node listens.
std::vector<std::string> UnreadTopics(const MotionTopics& topics) {
  ros::master::V_TopicInfo published;
  if (!ros::master::getTopics(published)) return {};
  TopicContents contents;
  for (const ros::master::TopicInfo& info : published) contents[info.name].type = info.datatype;
  std::vector<std::string> sentences;
  for (const std::string& topic : MotionTopicsBesides(contents, topics))
    sentences.push_back("there is " + topic + " (" + contents[topic].type +
                        "), which is not read; see ~joint_states, ~tf and ~use_joint_states");
  return sentences;
}

// Physics and telemetry are never left out; markers are, while there is no time for them.
void AdvanceTimed(CableEngine* engine, NodeSink* sink) {
  engine->SendMarkers(!sink->pace()->behind());
  sink->pace()->Begin(engine->started() ? engine->now() : 0, Clock::now());
  engine->Advance(sink);
  sink->pace()->Reached(engine->now(), Clock::now());
}

}  // namespace

ExitCode RunNode(const NodeOptions& options) {
  Problems problems;
  const Inputs inputs = LoadNodeInputs(options, &problems);
  if (!problems.empty()) {
    for (const Problem& problem : problems.all()) ROS_FATAL_STREAM(problem.ToString());
    return kExitBadInput;
  }
  for (const Problem& warning : inputs.vehicle.warnings.all()) ROS_WARN_STREAM(warning.ToString());
  for (const Problem& note : inputs.vehicle.notes.all()) ROS_WARN_STREAM(note.ToString());
  CableEngine engine(inputs.vehicle, inputs.bodies, inputs.cables.cables, options.engine);
  std::vector<std::string> names;
  for (const CableModel& cable : inputs.cables.cables) names.push_back(cable.name);
  ros::NodeHandle node;
  NodeSink sink(&node, names);

  const auto hints = ros::TransportHints().tcpNoDelay();
  const MotionTopics& topics = options.engine.links.topics;
  const bool by_arrival = topics.use_record_times;
  const ros::Subscriber tf = node.subscribe<tf2_msgs::TFMessage, const TfEvent&>(
      topics.tf, kInputQueue, boost::function<void(const TfEvent&)>([&](const TfEvent& event) {
        const tf2_msgs::TFMessage& message = *event.getConstMessage();
        engine.Ingest(by_arrival ? Restamped(message) : message, false, event.getPublisherName(),
                      Arrival());
      }),
      ros::VoidConstPtr(), hints);
  const ros::Subscriber tf_static = node.subscribe<tf2_msgs::TFMessage, const TfEvent&>(
      topics.tf_static(), kInputQueue,
      boost::function<void(const TfEvent&)>([&](const TfEvent& event) {
        engine.Ingest(*event.getConstMessage(), true, event.getPublisherName());
      }),
      ros::VoidConstPtr(), hints);
  ros::Subscriber joints;
  if (options.use_joint_states) {
    joints = node.subscribe<sensor_msgs::JointState, const JointEvent&>(
        topics.joint_states, kInputQueue,
        boost::function<void(const JointEvent&)>([&](const JointEvent& event) {
          const sensor_msgs::JointState& message = *event.getConstMessage();
          engine.Ingest(by_arrival ? Restamped(message) : message, event.getPublisherName(),
                        Arrival());
        }),
        ros::VoidConstPtr(), hints);
  }
  ROS_INFO_STREAM(names.size() << " cables wait for the transforms of their links");

  const Clock::time_point start = Clock::now();
  while (ros::ok()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kSpinSeconds));
    const bool was_behind = sink.pace()->behind();
    AdvanceTimed(&engine, &sink);
    if (sink.pace()->behind() != was_behind) {
      ROS_WARN_STREAM((was_behind ? "on time again: markers are back"
                                  : "cannot keep up with the clock: markers are left out"));
    }
    for (const std::string& news : engine.TakeNews()) ROS_WARN_STREAM(news);
    if (engine.started()) {
      const std::string hint = GravityHint(options.engine.gravity_W, engine.links().world());
      if (!hint.empty()) ROS_WARN_STREAM_ONCE(hint);
    }
    if (sink.SecondsSinceLast() > kWaitingPeriod) {
      std::vector<std::string> reasons = engine.links().Missing();
      if (!reasons.empty()) {
        for (const auto& more : {engine.links().Advice(), UnreadTopics(topics)})
          reasons.insert(reasons.end(), more.begin(), more.end());
      } else {
        bool nothing = false;
        const LinkMotion& links = engine.links();
        for (const Finding& finding : links.CoverageFindings(links.world(), &nothing))
          reasons.push_back(finding.ToString());
      }
      sink.ReportWaiting(engine.started(), reasons);
    }
  }

  Summary summary = engine.MakeSummary();
  summary.wall_time = std::chrono::duration<double>(Clock::now() - start).count();
  summary.peak_memory = PeakMemory();
  // rosout is gone by now.
  std::fputs(summary.ToText().c_str(), stdout);
  if (!options.json.empty() && !WriteTextFile(options.json, summary.ToJson())) {
    return kExitFileTrouble;
  }
  return engine.AnyFailed() ? kExitFailed : kExitDone;
}

}  // namespace cosserat_cable
