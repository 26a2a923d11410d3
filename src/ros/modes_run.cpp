#include "cosserat_cable/ros/modes_run.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <vector>

#include "cosserat_cable/cable/cable_check.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/cable/contact_stiffness.h"
#include "cosserat_cable/console/planned_outputs.h"
#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/input/yaml_value.h"
#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/ros/inputs.h"
#include "cosserat_cable/ros/summary.h"
#include "cosserat_cable/vehicle/joint_positions.h"
#include "diagnostics.h"
#include "modes_report.h"

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kMostModes = 100;
// Longer than any recording; in nanoseconds it still is a number [s].
constexpr double kLongest = 1e9;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What is settled, and where its clamps are.
struct Scene {
  CableFile cables;
  BodyMap bodies;
  std::vector<Surroundings> surroundings;           // of each cable
  std::vector<std::vector<const Body*>> obstacles;  // likewise
  ModesSetting setting;
  std::vector<std::string> files;  // that were read
};

void CheckClamps(std::size_t i, const Scene& scene, Problems* problems) {
  const double chord = (scene.surroundings[i].b.X.p - scene.surroundings[i].a.X.p).norm();
  CheckClampDistance(scene.cables.cables[i], scene.cables.marks[i], chord, problems);
}

using Place = std::function<Pose(const std::string& link)>;

Place ByJoints(const ModesOptions& options, const VehicleModel& vehicle, ModesSetting* setting,
               Problems* problems) {
  const JointPositions given = ReadJointPositions(options.joints, vehicle, problems);
  setting->joints = CompletePositions(vehicle, given);
  setting->notes = RestNotes(vehicle, given);
  setting->frame = vehicle.root;
  if (given.empty() && setting->notes.empty() && !setting->joints.empty())
    setting->notes.push_back("all joints stand at zero; --joints or --bag places them");
  return [&vehicle, positions = setting->joints](const std::string& link) {
    return PoseInRoot(vehicle, link, positions);
  };
}

std::string RangeText(std::int64_t from, std::int64_t to) {
  return "stamps " + StampText(from) + " to " + StampText(to);
}

// The samples' first stamp, and the range in which all links are known; feeds `links` with all.
struct Recorded {
  std::int64_t first = 0, begin = 0, end = 0;  // [ns]
};

Recorded ReadRecording(const BagReader& bags, LinkMotion* links) {
  bags.ForEach(bags.begin_time(), bags.end_time(), [&](const BagMessage& message) {
    if (message.tf) links->Ingest(*message.tf, message.is_static);
    if (message.joints) links->Ingest(*message.joints);
    return true;
  });
  links->Finish();
  Recorded recorded;
  links->Range(&recorded.begin, &recorded.end);
  recorded.first = recorded.begin;
  for (const auto& [child, edge] : links->edges())
    if (edge.samples > 0) recorded.first = std::min(recorded.first, edge.first);
  return recorded;
}

// A position that is read off where the recording says it; empty where it does not.
void ReadJoints(const VehicleModel& vehicle, const LinkMotion& links, std::int64_t time,
                ModesSetting* setting) {
  const auto& needed = links.links();
  for (const JointModel& joint : vehicle.joints) {
    const auto has = [&](const std::string& link) {
      return std::count(needed.begin(), needed.end(), link) > 0;
    };
    if (!has(joint.parent) || !has(joint.child)) continue;
    const Pose X_PC =
        links.Evaluate(joint.parent, time).X.Inverse() * links.Evaluate(joint.child, time).X;
    const Pose X_JC = joint.X_PJ.Inverse() * X_PC;
    if (joint.type == JointModel::Type::kRevolute)
      setting->joints[joint.name] = joint.axis.dot(RotationLog(X_JC.q));
    if (joint.type == JointModel::Type::kPrismatic)
      setting->joints[joint.name] = joint.axis.dot(X_JC.p);
  }
}

Place ByRecording(const ModesOptions& options, const Inputs& inputs, LinkMotion* links,
                  ModesSetting* setting, Problems* problems) {
  const Recorded recorded = ReadRecording(*inputs.bags, links);
  const auto seconds = [&](std::int64_t stamp) {
    return 1e-9 * static_cast<double>(stamp - recorded.first);
  };
  const std::int64_t time =
      recorded.first + std::llround(1e9 * std::clamp(*options.time, -kLongest, kLongest));
  if (time < recorded.begin || time > recorded.end) {
    problems->Add("", 0, "time",
                  "got " + FormatNumber(*options.time) + " s, expected " +
                      FormatRounded(seconds(recorded.begin), 4) + " to " +
                      FormatRounded(seconds(recorded.end), 4) +
                      " s after the recording's first sample, where all links are known (" +
                      RangeText(recorded.begin, recorded.end) + ")");
    return {};
  }
  setting->frame = inputs.survey->world;
  setting->time = options.time;
  setting->stamp = time;
  setting->notes = inputs.survey->notes;
  for (const std::string& link : links->links()) {
    if (!links->InGap(link, time)) continue;
    setting->notes.push_back("the recording has a gap at this time: link '" + link +
                             "' is held where it was");
  }
  ReadJoints(inputs.vehicle, *links, time, setting);
  return [links, time](const std::string& link) { return links->Evaluate(link, time).X; };
}

void CheckPlacing(const ModesOptions& options, Problems* problems) {
  const bool by_bag = !options.bags.empty();
  if (!options.a.empty()) problems->Add("", 0, "a", "the vehicle's links place the clamps");
  if (!options.b.empty()) problems->Add("", 0, "b", "the vehicle's links place the clamps");
  if (by_bag && !options.joints.empty())
    problems->Add("", 0, "joints", "the recording moves the joints: give --joints or --bag");
  if (by_bag && !options.time)
    problems->Add("", 0, "time", "missing: seconds after the recording's first sample");
  if (!by_bag && options.time)
    problems->Add("", 0, "time", "got a time without a recording: give --bag");
  if (options.time && !std::isfinite(*options.time))
    problems->Add("", 0, "time", "got a time that is not finite");
}

// Needs no recording: nothing reads one.
void RefuseRecordingOptions(const ModesOptions& options, Problems* problems) {
  const MotionTopics usual, &topics = options.engine.links.topics;
  const auto refuse = [problems](bool given, const char* key) {
    if (given) problems->Add("", 0, key, "is for a recording: give --bag");
  };
  refuse(topics.joint_states != usual.joint_states, "joint-states");
  refuse(topics.tf != usual.tf, "tf");
  refuse(topics.use_record_times, "use-record-times");
  refuse(!options.engine.links.tf_prefix.empty(), "tf-prefix");
  refuse(!options.engine.links.world_frame.empty(), "world-frame");
  refuse(!options.engine.links.held_joints.empty(), "hold");
  refuse(options.engine.links.smooth != 0, "smooth");
}

Scene OnVehicle(const ModesOptions& options, Problems* problems) {
  InputPaths paths;
  paths.vehicle = options.vehicle;
  paths.cables = options.cables;
  paths.sections = options.sections;
  paths.bags = options.bags;
  CheckPlacing(options, problems);
  if (options.bags.empty()) RefuseRecordingOptions(options, problems);
  Inputs inputs = LoadInputs(paths, options.engine, problems);
  Scene scene;
  scene.files = FilesRead(paths, inputs);
  Place place;
  LinkMotionOptions link_options = options.engine.links;
  link_options.judge = false;
  if (inputs.survey) {
    link_options.world_frame = inputs.survey->world;
    link_options.constants = inputs.survey->constants;
  }
  std::optional<LinkMotion> links;
  if (options.bags.empty()) {
    if (!inputs.vehicle.root.empty())
      place = ByJoints(options, inputs.vehicle, &scene.setting, problems);
  } else if (problems->empty()) {
    links.emplace(inputs.vehicle, NeededLinks(inputs.cables.cables), link_options);
    place = ByRecording(options, inputs, &*links, &scene.setting, problems);
  }
  scene.cables = std::move(inputs.cables);
  scene.bodies = std::move(inputs.bodies);
  if (!problems->empty()) return scene;
  for (std::size_t i = 0; i < scene.cables.cables.size(); ++i) {
    const CableModel& cable = scene.cables.cables[i];
    const auto clamp = [&place](const ClampModel& model) {
      return Motion::Resting(place(model.link) * model.X_LC);
    };
    Surroundings now{clamp(cable.a), clamp(cable.b), {}};
    std::vector<const Body*> obstacles;
    for (const std::string& link : cable.avoid) {
      const Body* body = FindBody(scene.bodies, cable, link);
      if (!body) continue;
      obstacles.push_back(body);
      now.obstacles.push_back(Motion::Resting(place(link)));
    }
    scene.surroundings.push_back(std::move(now));
    scene.obstacles.push_back(std::move(obstacles));
    CheckClamps(i, scene, problems);
  }
  return scene;
}

std::optional<Pose> ReadPose(const std::string& text, const char* key, Problems* problems) {
  if (text.empty()) {
    problems->Add("", 0, key, "missing: the pose of a specimen's clamp, x,y,z,qx,qy,qz,qw");
    return std::nullopt;
  }
  if (text == "free") {
    problems->Add("", 0, key, "a cable with a free end cannot be simulated, give a pose");
    return std::nullopt;
  }
  Problems found;
  std::optional<Pose> pose;
  try {
    pose = YamlValue::Root("", YAML::Load("[" + text + "]"), &found).PoseOf();
  } catch (const YAML::Exception&) {
    found.Add("", "got '" + text + "', expected x,y,z,qx,qy,qz,qw");
  }
  for (const Problem& problem : found.all()) problems->Add("", 0, key, problem.message);
  return pose;
}

Scene Specimen(const ModesOptions& options, Problems* problems) {
  Scene scene;
  scene.cables = LoadCableFile(options.cables, problems, options.sections);
  if (problems->empty() && !scene.cables.specimen) {
    problems->Add("", 0, "vehicle", "missing: the file has `cables:`, which hang on a vehicle");
    return scene;
  }
  RefuseRecordingOptions(options, problems);
  if (!options.bags.empty()) problems->Add("", 0, "bag", "a specimen is not recorded");
  if (!options.joints.empty()) problems->Add("", 0, "joints", "a specimen has no joints");
  if (options.time) problems->Add("", 0, "time", "a specimen is not recorded");
  scene.setting.frame = "the clamps' frame";
  const std::optional<Pose> a = ReadPose(options.a, "a", problems);
  const std::optional<Pose> b = ReadPose(options.b, "b", problems);
  if (!problems->empty() || !a || !b) return scene;
  scene.surroundings.push_back({Motion::Resting(*a), Motion::Resting(*b), {}});
  scene.obstacles.emplace_back();
  CheckClamps(0, scene, problems);
  return scene;
}

PlannedOutputs CheckOutputs(const ModesOptions& options, Problems* problems) {
  if (options.count < 1 || options.count > kMostModes)
    problems->Add(
        "", 0, "count",
        "got " + std::to_string(options.count) + ", expected 1 to " + std::to_string(kMostModes));
  PlannedOutputs outputs;
  AddReads({options.vehicle, options.cables, options.sections, options.bags}, &outputs);
  outputs.WritesFolder(options.output, "output", {"modes.json", "cables.yaml"});
  outputs.WritesFile(options.json, "json");
  outputs.Check(problems);
  return outputs;
}

// A cable that lies too deep in a body is not where it would rest.
std::string DepthWarning(const CableModel& cable, double penetration) {
  const double needed = SufficientContactStiffness(cable, penetration);
  if (!(needed > 0)) return "";
  char text[200];
  std::snprintf(text, sizeof text,
                "rests %.3g mm deep in a body, %.0f %% of its radius; `contact: {stiffness: %.1e}` "
                "would keep it within %.0f %%",
                1e3 * penetration, 200 * penetration / cable.diameter, needed,
                100 * kDeepestShareOfRadius);
  return text;
}

CableModes Find(std::size_t i, const Scene& scene, int count) {
  CableModes found;
  found.model = scene.cables.cables[i];
  CableSimulation simulation(found.model, scene.obstacles[i], scene.setting.gravity,
                             EngineOptions().clearance_reach);
  const StepOutcome outcome = simulation.Settle(scene.surroundings[i]);
  if (!outcome.ok) {
    found.failure = outcome.message;
    return found;
  }
  found.rest = simulation.nodes();
  found.touches = simulation.Report().contact_force > 0;
  found.warning = DepthWarning(found.model, simulation.DeepestContact().penetration);
  const Clock::time_point start = Clock::now();
  try {
    found.modes = simulation.FindModes(count);
  } catch (const std::runtime_error& error) {
    found.failure = error.what();
  }
  found.wall_time = Since(start);
  return found;
}

bool Write(const fs::path& path, const std::string& text) {
  if (WriteTextFile(path.string(), text)) return true;
  std::cerr << path.string() << ": could not be written\n";
  return false;
}

}  // namespace

ExitCode RunModes(ModesOptions options) {
  const Clock::time_point start = Clock::now();
  Problems problems;
  PlannedOutputs outputs = CheckOutputs(options, &problems);
  options.engine.ApplyGravity(&problems);
  Scene scene =
      options.vehicle.empty() ? Specimen(options, &problems) : OnVehicle(options, &problems);
  std::vector<std::string> shapes;
  for (const CableModel& cable : scene.cables.cables) shapes.push_back(cable.name + ".csv");
  outputs.WritesFolder(options.output, "output", shapes);
  scene.files.push_back(options.cables);
  outputs.CheckReads(scene.files, &problems);
  if (!problems.empty()) {
    std::cerr << problems.ToString();
    return kExitBadInput;
  }

  scene.setting.gravity = options.engine.gravity_W;
  // With a recording it is among the survey's notes.
  const std::string hint = GravityHint(scene.setting.gravity, scene.setting.frame);
  if (options.bags.empty() && !hint.empty()) scene.setting.notes.push_back(hint);
  std::cout << SettingText(scene.setting);

  std::vector<CableModes> cables;
  ExitCode code = kExitDone;
  for (std::size_t i = 0; i < scene.cables.cables.size(); ++i) {
    cables.push_back(Find(i, scene, options.count));
    std::cout << ModesText(cables.back());
    if (!cables.back().failure.empty()) code = kExitFailed;
  }
  const double wall_time = Since(start);
  char line[120];
  std::snprintf(line, sizeof line, "%zu cable%s in %.2f s, peak memory %.0f MB\n", cables.size(),
                cables.size() == 1 ? "" : "s", wall_time, PeakMemory() / 1e6);
  std::cout << line;

  const std::string json = ModesJson(cables, scene.setting, wall_time);
  if (!options.json.empty() && !Write(options.json, json)) code = kExitFileTrouble;
  if (options.output.empty()) return code;
  std::error_code trouble;
  fs::create_directories(options.output, trouble);
  if (trouble) {
    std::cerr << options.output << ": " << trouble.message() << "\n";
    return kExitFileTrouble;
  }
  const fs::path folder = options.output;
  bool written =
      Write(folder / "modes.json", json) &&
      Write(folder / "cables.yaml", SettingComment(scene.setting) + WriteCableFile(scene.cables));
  for (const CableModes& cable : cables) {
    if (!cable.failure.empty()) continue;
    written = Write(folder / (cable.model.name + ".csv"), ModesCsv(cable)) && written;
  }
  return written ? code : kExitFileTrouble;
}

}  // namespace cosserat_cable
