#include "cosserat_cable/ros/modes_run.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <vector>

#include "cosserat_cable/cable/cable_check.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/cable/contact_stiffness.h"
#include "cosserat_cable/input/yaml_value.h"
#include "cosserat_cable/ros/inputs.h"
#include "cosserat_cable/ros/summary.h"
#include "modes_report.h"

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kMostModes = 100;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What is settled, and where its clamps are.
struct Scene {
  CableFile cables;
  BodyMap bodies;
  std::vector<Surroundings> surroundings;           // of each cable
  std::vector<std::vector<const Body*>> obstacles;  // likewise
};

/// Of a link in the root, all joints at zero.
Pose PoseAtZero(const VehicleModel& vehicle, const std::string& link) {
  Pose X_RL;
  std::string at = link;
  while (at != vehicle.root) {
    const auto joint = std::find_if(vehicle.joints.begin(), vehicle.joints.end(),
                                    [&at](const JointModel& j) { return j.child == at; });
    X_RL = joint->Evaluate(joint->mimic.empty() ? 0.0 : joint->mimic_offset) * X_RL;
    at = joint->parent;
  }
  return X_RL;
}

void CheckClamps(std::size_t i, const Scene& scene, Problems* problems) {
  const double chord = (scene.surroundings[i].b.X.p - scene.surroundings[i].a.X.p).norm();
  CheckClampDistance(scene.cables.cables[i], scene.cables.marks[i], chord, problems);
}

Scene OnVehicle(const ModesOptions& options, Problems* problems) {
  InputPaths paths;
  paths.vehicle = options.vehicle;
  paths.cables = options.cables;
  Inputs inputs = LoadInputs(paths, EngineOptions(), problems);
  Scene scene;
  scene.cables = std::move(inputs.cables);
  scene.bodies = std::move(inputs.bodies);
  if (!options.a.empty()) problems->Add("", 0, "a", "the vehicle's links place the clamps");
  if (!options.b.empty()) problems->Add("", 0, "b", "the vehicle's links place the clamps");
  if (!problems->empty()) return scene;
  for (std::size_t i = 0; i < scene.cables.cables.size(); ++i) {
    const CableModel& cable = scene.cables.cables[i];
    const auto place = [&inputs](const ClampModel& clamp) {
      return Motion::Resting(PoseAtZero(inputs.vehicle, clamp.link) * clamp.X_LC);
    };
    Surroundings now{place(cable.a), place(cable.b), {}};
    std::vector<const Body*> obstacles;
    for (const std::string& link : cable.avoid) {
      const Body* body = FindBody(scene.bodies, cable, link);
      if (!body) continue;
      obstacles.push_back(body);
      now.obstacles.push_back(Motion::Resting(PoseAtZero(inputs.vehicle, link)));
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
  scene.cables = LoadCableFile(options.cables, problems);
  if (problems->empty() && !scene.cables.specimen) {
    problems->Add("", 0, "vehicle", "missing: the file has `cables:`, which hang on a vehicle");
    return scene;
  }
  const std::optional<Pose> a = ReadPose(options.a, "a", problems);
  const std::optional<Pose> b = ReadPose(options.b, "b", problems);
  if (!problems->empty() || !a || !b) return scene;
  scene.surroundings.push_back({Motion::Resting(*a), Motion::Resting(*b), {}});
  scene.obstacles.emplace_back();
  CheckClamps(0, scene, problems);
  return scene;
}

void CheckOutputs(const ModesOptions& options, Problems* problems) {
  if (options.count < 1 || options.count > kMostModes)
    problems->Add(
        "", 0, "count",
        "got " + std::to_string(options.count) + ", expected 1 to " + std::to_string(kMostModes));
  std::error_code ignored;
  if (!options.output.empty() && fs::exists(options.output, ignored) &&
      !fs::is_directory(options.output, ignored))
    problems->Add(options.output, 0, "output", "got a file, expected a folder");
  if (!options.json.empty() && fs::is_directory(options.json, ignored))
    problems->Add(options.json, 0, "json", "got a folder, expected a file");
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
  const EngineOptions defaults;
  CableModes found;
  found.model = scene.cables.cables[i];
  CableSimulation simulation(found.model, scene.obstacles[i], defaults.gravity_W,
                             defaults.clearance_reach);
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

ExitCode RunModes(const ModesOptions& options) {
  const Clock::time_point start = Clock::now();
  Problems problems;
  CheckOutputs(options, &problems);
  const Scene scene =
      options.vehicle.empty() ? Specimen(options, &problems) : OnVehicle(options, &problems);
  if (!problems.empty()) {
    std::cerr << problems.ToString();
    return kExitBadInput;
  }

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

  const std::string json = ModesJson(cables, wall_time);
  if (!options.json.empty() && !Write(options.json, json)) code = kExitFileTrouble;
  if (options.output.empty()) return code;
  std::error_code trouble;
  fs::create_directories(options.output, trouble);
  if (trouble) {
    std::cerr << options.output << ": " << trouble.message() << "\n";
    return kExitFileTrouble;
  }
  const fs::path folder = options.output;
  bool written = Write(folder / "modes.json", json) &&
                 Write(folder / "cables.yaml", WriteCableFile(scene.cables));
  for (const CableModes& cable : cables) {
    if (!cable.failure.empty()) continue;
    written = Write(folder / (cable.model.name + ".csv"), ModesCsv(cable)) && written;
  }
  return written ? code : kExitFileTrouble;
}

}  // namespace cosserat_cable
