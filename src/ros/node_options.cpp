#include <map>
#include <string>

#include "cosserat_cable/ros/cable_node.h"

namespace cosserat_cable {
namespace {

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

}  // namespace

NodeOptions ReadNodeOptions(const ros::NodeHandle& parameters, Problems* problems) {
  NodeOptions options;
  EngineOptions& engine = options.engine;
  ParameterReader reader(parameters, problems);
  reader.Read("vehicle", "the path of a URDF file", &options.inputs.vehicle);
  reader.Read("cables", "the path of a YAML file", &options.inputs.cables);
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
  reader.Read("dump_directory", "a folder", &engine.dump_directory);
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
