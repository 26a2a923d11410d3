#include "cosserat_cable/ros/cable_node.h"

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/message_event.h>
#include <ros/param.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "cosserat_cable/console/interrupt.h"
#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/ros/conversions.h"
#include "master_watch.h"
#include "node_sink.h"

namespace cosserat_cable {
namespace {

// Bursts of `rosbag play -r 5` and the time that a slow step takes fit in [messages].
constexpr std::uint32_t kInputQueue = 20'000;
constexpr double kSpinSeconds = 0.02;
// So long the cables are advanced before messages are taken again [s].
constexpr double kSliceSeconds = 0.2;
// What is left to be simulated when the node is stopped gets so long [s].
constexpr double kLastSeconds = 1;
// What is published then gets so long to leave, and a message so much more, up to the most [s].
constexpr double kFlushSeconds = 0.3, kFlushPerMessage = 1e-4, kLongestFlush = 0.7;
// Input that is left unsimulated is worth telling where it is more than motion curves wait for [s].
constexpr double kLatency = 0.5;

using Clock = NodeSink::Clock;
using TfEvent = ros::MessageEvent<const tf2_msgs::TFMessage>;
using JointEvent = ros::MessageEvent<const sensor_msgs::JointState>;

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

// `description`: of robot_description, where that is the vehicle.
Inputs LoadNodeInputs(const NodeOptions& options, std::string* description, Problems* problems) {
  if (!options.inputs.vehicle.empty()) return LoadInputs(options.inputs, options.engine, problems);
  if (!ros::param::get("robot_description", *description)) {
    problems->Add("", 0, "vehicle",
                  "neither the parameter ~vehicle (a URDF file) nor robot_description is set");
    return {};
  }
  const DescriptionFile file(*description);
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

double SecondsSince(Clock::time_point time) {
  return std::chrono::duration<double>(Clock::now() - time).count();
}

// Physics and telemetry are never left out; markers are, while there is no time for them.
void AdvanceTimed(CableEngine* engine, NodeSink* sink, const std::function<bool()>& stop) {
  engine->SendMarkers(!sink->pace()->behind());
  sink->pace()->Begin(engine->started() ? engine->now() : 0, Clock::now());
  engine->Advance(sink, stop);
  sink->pace()->Reached(engine->now(), Clock::now());
}

// Why nothing moves.
std::vector<std::string> Reasons(const CableEngine& engine, const MotionTopics& topics) {
  const LinkMotion& links = engine.links();
  std::vector<std::string> reasons = links.Missing();
  if (!reasons.empty()) {
    for (const auto& more : {links.Advice(), UnreadTopics(topics)})
      reasons.insert(reasons.end(), more.begin(), more.end());
    return reasons;
  }
  bool nothing = false;
  for (const Finding& finding : links.CoverageFindings(links.world(), &nothing))
    reasons.push_back(finding.ToString());
  if (reasons.empty() && !engine.started())
    reasons.push_back("for a second of stamps, in which a frame above '" + links.world() +
                      "' may come, which would be the inertial one");
  return reasons;
}

void SayStart(const NodeOptions& options, const Inputs& inputs) {
  const EngineOptions& engine = options.engine;
  ROS_INFO_STREAM(
      "vehicle: " << (options.inputs.vehicle.empty() ? "robot_description" : options.inputs.vehicle)
                  << ", root '" << inputs.vehicle.root << "'; inertial frame: "
                  << (engine.links.world_frame.empty() ? "the one above all"
                                                       : "'" + engine.links.world_frame + "'")
                  << "; gravity " << engine.gravity_W.transpose() << " m/s^2");
  ROS_INFO_STREAM("step " << 1e3 * engine.dt << " ms; telemetry " << engine.telemetry_rate
                          << " Hz, markers " << engine.marker_rate << " Hz; transforms of "
                          << engine.links.topics.tf
                          << (options.use_joint_states ? ", " + engine.links.topics.joint_states
                                                       : std::string()));
  for (const CableModel& cable : inputs.cables.cables)
    ROS_INFO_STREAM("cable '" << cable.name << "': '" << cable.a.link << "' to '" << cable.b.link
                              << "', " << cable.length << " m, " << cable.elements
                              << " elements, avoids " << cable.avoid.size() << " links");
  ROS_INFO_STREAM(inputs.cables.cables.size() << " cables wait for the transforms of their links");
}

// The curves wait for samples that will not come any more; true where all was simulated.
bool SimulateRest(CableEngine* engine, NodeSink* sink) {
  const Clock::time_point start = Clock::now();
  engine->Finish();
  AdvanceTimed(engine, sink, [start] { return SecondsSince(start) > kLastSeconds; });
  std::int64_t begin = 0, ready = 0;
  // Where a link's transforms stopped, there is nothing to be simulated behind them.
  if (!engine->started() || !engine->links().Range(&begin, &ready)) return true;
  const double left = static_cast<double>(ready - engine->now()) * 1e-9;
  if (left <= kLatency) return true;
  ROS_WARN_STREAM("stopped " << left << " s before the end of the motion at " << StampText(ready)
                             << ": the machine could not keep up, and the rest was not simulated");
  return false;
}

}  // namespace

ExitCode RunNode(const NodeOptions& options, Problems problems) {
  std::string description;
  // A missing path is a problem already.
  const Inputs inputs =
      options.inputs.cables.empty() ? Inputs() : LoadNodeInputs(options, &description, &problems);
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
  SayStart(options, inputs);
  // From here on there is something to be kept.
  CatchInterrupts();

  const Clock::time_point start = Clock::now();
  MasterWatch master(description);
  const auto say_news = [&engine] {
    for (const std::string& news : engine.TakeNews()) ROS_WARN_STREAM(news);
  };
  while (ros::ok() && !Interrupted()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kSpinSeconds));
    const Clock::time_point now = Clock::now();
    AdvanceTimed(&engine, &sink,
                 [now] { return Interrupted() || SecondsSince(now) > kSliceSeconds; });
    say_news();
    if (engine.started()) {
      const std::string hint = GravityHint(options.engine.gravity_W, engine.links().world());
      if (!hint.empty()) ROS_WARN_STREAM_ONCE(hint);
    }
    master.Look();
    sink.Watch(engine, [&] { return Reasons(engine, topics); });
  }

  const std::uint64_t published = sink.telemetry_count();
  const bool is_whole = SimulateRest(&engine, &sink);
  say_news();
  Summary summary = engine.MakeSummary();
  summary.wall_time = SecondsSince(start);
  summary.peak_memory = PeakMemory();
  // To whoever reads the console; rosout may be gone by now.
  std::fputs(summary.ToText().c_str(), stdout);
  std::printf("published %llu messages of telemetry\n",
              static_cast<unsigned long long>(sink.telemetry_count()));
  std::fflush(stdout);
  // What is still in the publishers' queues is sent by a thread of its own.
  const auto last = static_cast<double>(sink.telemetry_count() - published);
  ros::WallDuration(std::min(kFlushSeconds + kFlushPerMessage * last, kLongestFlush)).sleep();
  if (!options.json.empty() && !WriteTextFile(options.json, summary.ToJson())) {
    ROS_ERROR_STREAM(options.json << ": could not be written");
    return kExitFileTrouble;
  }
  if (engine.AnyFailed()) return kExitFailed;
  return is_whole ? kExitDone : kExitInterrupted;
}

}  // namespace cosserat_cable
