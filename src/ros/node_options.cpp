#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/ros/cable_node.h"

namespace cosserat_cable {
namespace {

// Nobody restarts a live node for a pose that was reset [s].
constexpr double kSettleAgain = 5;

class ParameterReader {
 public:
  ParameterReader(const ros::NodeHandle& node, Problems* problems)
      : node_(node), problems_(problems) {}

  template <typename T>
  void Read(const std::string& key, const char* expected, T* value) {
    if (node_.hasParam(key) && !node_.getParam(key, *value)) {
      problems_->Add("", 0, node_.resolveName(key), std::string("expected ") + expected);
    }
  }

 private:
  const ros::NodeHandle& node_;
  Problems* problems_;
};

// "X,Y,Z", or a list of three numbers.
void ReadGravityParameter(const ros::NodeHandle& node, Problems* problems,
                          Eigen::Vector3d* gravity) {
  std::string text;
  std::vector<double> numbers;
  std::optional<Eigen::Vector3d> read;
  Problems found;
  if (!node.hasParam("gravity")) return;
  if (node.getParam("gravity", text)) {
    // A launch file's argument that nobody gave.
    if (text.empty()) return;
    read = ReadGravity(text, &found);
  } else if (node.getParam("gravity", numbers)) {
    read = ReadGravity(numbers, &found);
  } else {
    found.Add("", 0, "gravity", "expected \"X,Y,Z\" or a list of three numbers [m/s^2]");
  }
  for (const Problem& problem : found.all())
    problems->Add("", 0, node.resolveName("gravity"), problem.message);
  if (read) *gravity = *read;
}

}  // namespace

NodeOptions ReadNodeOptions(const ros::NodeHandle& parameters, Problems* problems) {
  NodeOptions options;
  EngineOptions& engine = options.engine;
  engine.links.is_node = true;
  ParameterReader reader(parameters, problems);
  reader.Read("vehicle", "the path of a URDF file", &options.inputs.vehicle);
  reader.Read("cables", "the path of a YAML file", &options.inputs.cables);
  reader.Read("sections", "a list of [NAME=]FILE", &options.inputs.sections);
  reader.Read("use_joint_states", "true or false", &options.use_joint_states);
  reader.Read("json", "a path", &options.json);
  reader.Read("world_frame", "a frame", &engine.links.world_frame);
  reader.Read("hold_joints", "a list of joints", &engine.links.held_joints);
  reader.Read("max_gap", "a number [s]", &engine.links.max_gap);
  reader.Read("smooth", "a number [Hz]", &engine.links.smooth);
  reader.Read("dt", "a number [s]", &engine.dt);
  reader.Read("telemetry_rate", "a number [Hz]", &engine.telemetry_rate);
  reader.Read("marker_rate", "a number [Hz]", &engine.marker_rate);
  reader.Read("amplitude_window", "a number [s]", &engine.amplitude_window);
  reader.Read("clearance_reach", "a number [m]", &engine.clearance_reach);
  reader.Read("curvature_scale", "a number [1/m]", &engine.markers.curvature_scale);
  reader.Read("threads", "a whole number (0: one per core)", &engine.threads);
  engine.settle_again = kSettleAgain;
  reader.Read("settle_again", "a number [s]", &engine.settle_again);
  reader.Read("dump_directory", "a folder", &engine.dump_directory);
  ReadGravityParameter(parameters, problems, &engine.gravity_W);
  reader.Read("joint_states", "a topic", &engine.links.topics.joint_states);
  reader.Read("tf", "a topic", &engine.links.topics.tf);
  reader.Read("tf_prefix", "a prefix of recorded frames", &engine.links.tf_prefix);
  reader.Read("use_record_times", "true or false", &engine.links.topics.use_record_times);
  std::string frame = "reference";
  reader.Read("amplitude_frame", "'reference' or 'world'", &frame);
  const std::map<std::string, AmplitudeFrame> frames = {{"reference", AmplitudeFrame::kReference},
                                                        {"world", AmplitudeFrame::kWorld}};
  const auto found = frames.find(frame);
  if (found == frames.end()) {
    problems->Add("", 0, parameters.resolveName("amplitude_frame"),
                  "got '" + frame + "', expected 'reference' or 'world'");
  } else {
    engine.amplitude_frame = found->second;
  }
  if (options.inputs.cables.empty()) {
    problems->Add("", 0, parameters.resolveName("cables"), "missing: the path of a YAML file");
  }
  return options;
}

}  // namespace cosserat_cable
