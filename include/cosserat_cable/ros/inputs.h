// Everything that a run reads, and all that is wrong with it, said before anything is simulated.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/console/planned_outputs.h"
#include "cosserat_cable/ros/bag_reader.h"
#include "cosserat_cable/ros/cable_engine.h"
#include "cosserat_cable/vehicle/vehicle_model.h"

namespace cosserat_cable {

struct InputPaths {
  std::string vehicle;  ///< URDF
  std::string cables;   ///< YAML
  /// Specimens whose section the cables have: "[NAME=]FILE".
  std::vector<std::string> sections;
  std::vector<std::string> bags;  ///< may be empty
  double start = 0;               ///< after the first bag's begin [s]
  double duration = 0;            ///< [s]; 0: to the end
  bool follow_clamps = false;     ///< through the whole recording, not only at its first instant
};

/// What a run with these inputs reads.
void AddReads(const InputPaths& paths, PlannedOutputs* outputs);

struct Inputs;

/// All files that a run with these inputs has read, with the meshes that its vehicle names.
std::vector<std::string> FilesRead(const InputPaths& paths, const Inputs& inputs);

/// What the bags will do to the cables.
struct BagSurvey {
  std::int64_t from = 0, to = 0;   ///< the part to be replayed, by time of recording [ns]
  std::string world;               ///< the inertial frame
  bool world_is_recorded = false;  ///< otherwise the URDF's root, for want of a frame above it
  std::map<std::string, LinkMotion::Edge> edges;
  std::vector<std::string> warnings;  ///< kinds of samples that do not count, with how many
  std::uint64_t gaps = 0;
  std::int64_t first_step = 0;     ///< when all links are known [ns]
  std::vector<double> chords;      ///< between each cable's clamps at that time [m]
  std::string topmost;             ///< the frame above all, where another one is the inertial frame
  std::vector<ClampJudge> clamps;  ///< of each cable, where they were followed
  Findings findings;               ///< what the recording says that cannot be
  std::vector<std::string> notes;  ///< what the user may want to set otherwise
  std::vector<ConstantEdge> constants;  ///< transforms that hold outside their samples too
};

struct Inputs {
  VehicleModel vehicle;
  CableFile cables;
  BodyMap bodies;  ///< of the links that cables avoid
  std::unique_ptr<BagReader> bags;
  std::optional<BagSurvey> survey;  ///< where the bags could be followed
  int triangles = 0;                ///< of all meshes that cables avoid
};

/// The options that name topics, frames or gravity, as they were given: " --gravity 0,0,9.81".
std::string SharedOptionsText(const EngineOptions& options);

/// The vehicle, with what its cables need of it.
VehicleModel LoadVehicleOf(const CableFile& cables, const std::string& path, Problems* problems);

/// Reads and checks it all. Where `problems` grew, the result serves for nothing but telling more.
Inputs LoadInputs(const InputPaths& paths, const EngineOptions& options, Problems* problems);

/// What contradicts itself, of vehicle and recording, besides the survey's findings.
std::vector<std::string> InputWarnings(const Inputs& inputs);

/// What the user may want to set or draw otherwise, of vehicle and recording.
std::vector<std::string> Notes(const Inputs& inputs);

/// For `cable_check`: cables, bags, and which frame is driven by what.
std::string Describe(const Inputs& inputs, const EngineOptions& options);
std::string DescribeJson(const Inputs& inputs, const EngineOptions& options,
                         const Problems& problems);

}  // namespace cosserat_cable
