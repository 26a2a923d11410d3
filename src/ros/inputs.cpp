#include "cosserat_cable/ros/inputs.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>

#include "avoided_links.h"
#include "clamp_survey.h"
#include "cosserat_cable/cable/cable_check.h"
#include "cosserat_cable/contact/body.h"
#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/vehicle/joint_positions.h"
#include "imu_gravity.h"
#include "upright_watch.h"

namespace cosserat_cable {
namespace {

// Enough of the past to see that a sample is out of order; the survey keeps no more in memory.
constexpr std::int64_t kSurveyHistory = 5'000'000'000;  // [ns]
// What is older is let go of this often: each time costs a walk over all edges.
constexpr std::uint64_t kDropInterval = 100;  // [messages]

std::string Join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// Longer than any recording; in nanoseconds it still is a number [s].
constexpr double kLongest = 1e9;

void CheckSeconds(double value, const char* option, const char* remark, Problems* problems) {
  if (value >= 0 && value <= kLongest) return;
  char text[120];
  std::snprintf(text, sizeof text, "got %g, expected 0 to 1e9 s%s", value, remark);
  problems->Add("", 0, option, text);
}

// Where the cables' clamps are when everything is first known, and whether cables can be hung
// there.
void CheckFirstInstant(const LinkMotion& links, std::int64_t time, const Inputs& inputs,
                       BagSurvey* survey, Problems* problems) {
  for (std::size_t i = 0; i < inputs.cables.cables.size(); ++i) {
    const CableModel& cable = inputs.cables.cables[i];
    const CableMarks& marks = inputs.cables.marks[i];
    const Pose X_WA = links.Evaluate(cable.a.link, time).X * cable.a.X_LC;
    const Pose X_WB = links.Evaluate(cable.b.link, time).X * cable.b.X_LC;
    const double chord = (X_WB.p - X_WA.p).norm();
    survey->chords.push_back(chord);
    CheckClampDistance(cable, marks, chord, problems);
    const std::string inside = ClampsInside(cable, X_WA, X_WB);
    if (!inside.empty()) survey->warnings.push_back("cable '" + cable.name + "': " + inside);
    for (const std::string& link : cable.avoid) {
      const Body* body = FindBody(inputs.bodies, cable, link);
      if (!body) continue;
      const Pose X_BW = links.Evaluate(link, time).X.Inverse();
      const auto check = [&](const Pose& X_WC, const char* name, const SourceMark& mark) {
        const Clearance clearance = body->Query(X_BW * X_WC.p, cable.diameter);
        // A clamp sits on a surface; one that is deeper than the cable is thick sits inside.
        if (clearance.distance >= -cable.diameter) return;
        char text[160];
        std::snprintf(text, sizeof text,
                      "clamp %s lies %.1f mm inside link '%s', which the cable avoids", name,
                      -1e3 * clearance.distance, link.c_str());
        problems->Add(mark, text);
      };
      check(X_WA, "a", marks.a_link);
      check(X_WB, "b", marks.b_link);
    }
  }
}

// What may be meant otherwise, though it can be simulated.
void AddNotes(const InputPaths& paths, const EngineOptions& options, const Inputs& inputs,
              BagSurvey* survey) {
  const std::string by_name = GravityHint(options.gravity_W, survey->world);
  if (!by_name.empty()) survey->notes.push_back(by_name);
  for (std::string& hint :
       ImuGravityHints(paths.bags, *inputs.bags, inputs.vehicle, *survey, options))
    survey->notes.push_back(std::move(hint));
  for (const std::string& name : options.links.held_joints) {
    const JointModel* joint = inputs.vehicle.FindJoint(name);
    const double rest = joint != nullptr ? RestPosition(inputs.vehicle, *joint) : 0;
    if (rest != 0) {
      survey->notes.push_back("joint '" + name + "' is held at " + FormatRounded(rest, 4) +
                              ", not at zero: its limits exclude that, or it follows another one");
    }
  }
}

void CheckRecording(const InputPaths& paths, const EngineOptions& options, Inputs* inputs,
                    Problems* problems) {
  const BagReader& bags = *inputs->bags;
  const std::string all = Join(paths.bags);
  BagSurvey survey;
  const double length = static_cast<double>(bags.end_time() - bags.begin_time()) * 1e-9;
  if (paths.start > length) {
    problems->Add(all, 0, "start",
                  "got " + FormatRounded(paths.start, 6) + " s, but the recording lasts " +
                      FormatRounded(length, 6) +
                      " s: --start counts from its first message, and is no stamp");
    return;
  }
  survey.from = bags.begin_time() + static_cast<std::int64_t>(paths.start * 1e9);
  survey.to = paths.duration > 0 ? survey.from + static_cast<std::int64_t>(paths.duration * 1e9)
                                 : std::numeric_limits<std::int64_t>::max();

  const std::vector<std::string> needed = NeededLinks(inputs->cables.cables);
  LinkMotionOptions link_options = options.links;
  LinkMotion links(inputs->vehicle, needed, link_options);
  std::uint64_t messages = 0;
  UprightWatch upright(options.gravity_W, inputs->vehicle.root);
  bags.ForEach(survey.from, survey.to, [&](const BagMessage& message) {
    Feed(message, &links);
    if (++messages % kDropInterval == 0) links.DropBefore(links.last_stamp() - kSurveyHistory);
    upright.Look(links);
    return true;
  });
  links.Finish();
  for (const std::string& reason : links.Missing()) {
    problems->Add(all, reason);
  }
  // What could not be used may be why.
  if (!links.Missing().empty())
    for (const std::string& warning : links.warnings().Sentences(links.Start()))
      problems->Add(all, warning);
  // How it may be mended, or what is likely to be missed.
  survey.notes = links.Advice();
  for (std::string& topic : UnreadMotion(bags.contents(), bags.topics()))
    survey.notes.push_back(std::move(topic));
  if (!links.Missing().empty())
    for (const std::string& advice : survey.notes) problems->Add(all, advice);
  survey.edges = links.edges();
  survey.warnings = links.warnings().Sentences(links.Start());
  survey.gaps = links.gap_count();
  survey.world = links.SmoothWorld();
  if (survey.world != links.world()) survey.topmost = links.world();
  // What is above the inertial frame moves no cable.
  for (auto above = survey.edges.find(survey.world); above != survey.edges.end();
       above = survey.edges.find(above->second.parent)) {
    if (above->second.is_followed) survey.gaps -= above->second.gaps;
    above->second.is_followed = false;
  }
  survey.constants = links.Constants(survey.world);
  for (const ConstantEdge& constant : survey.constants)
    survey.notes.push_back(constant.parent + " -> " + constant.child + " (" +
                           ToString(LinkMotion::Source::kTf, bags.topics()) +
                           ") never changes, and is sent every " +
                           FormatRounded(constant.interval, 3) +
                           " s: it is taken to hold in all of the recording, also before its first "
                           "sample and after its last one; " +
                           bags.topics().tf_static() + " is for such transforms");
  bool nothing = false;
  survey.findings = links.CoverageFindings(survey.world, &nothing);
  for (Finding& finding : links.MotionFindings(survey.world))
    survey.findings.push_back(std::move(finding));
  for (Finding& finding : upright.Report(survey.world))
    survey.findings.push_back(std::move(finding));
  for (Finding& finding : survey.findings) finding.start = links.Start();
  for (const auto& [child, edge] : survey.edges) {
    const bool by_tf =
        edge.source == LinkMotion::Source::kTf || edge.source == LinkMotion::Source::kTfStatic;
    if (by_tf && edge.parent == survey.world) survey.world_is_recorded = true;
  }
  if (!links.Missing().empty()) return;
  if (nothing) {
    problems->Add(
        all, "nothing would be simulated: the links are known together at one instant at most");
    for (const Finding& finding : survey.findings) problems->Add(all, finding.ToString());
    for (const std::string& advice : survey.notes) problems->Add(all, advice);
    if (links.Apart().front().find("two clocks") != std::string::npos)
      for (std::string& reason : links.Apart()) problems->Add(all, std::move(reason));
    return;
  }

  link_options.world_frame = survey.world;
  link_options.constants = survey.constants;
  link_options.judge = false;
  LinkMotion again(inputs->vehicle, needed, link_options);
  const auto dt = static_cast<std::int64_t>(options.dt * 1e9);
  const auto known = [&](bool all_read) {
    std::int64_t begin = 0, ready = 0;
    if (!again.Missing().empty() || !again.Range(&begin, &ready)) return false;
    // A recording of one instant has no other.
    survey.first_step = all_read && begin == ready ? begin : (begin + dt - 1) / dt * dt;
    return survey.first_step <= ready;
  };
  bool done = false;
  bags.ForEach(survey.from, survey.to, [&](const BagMessage& message) {
    Feed(message, &again);
    done = known(false);
    return !done;
  });
  if (!done) {
    again.Finish();
    done = known(true);
  }
  if (!done) {
    for (std::string& reason : links.Apart()) problems->Add(all, std::move(reason));
    return;
  }
  CheckFirstInstant(again, survey.first_step, *inputs, &survey, problems);
  AddNotes(paths, options, *inputs, &survey);
  if (paths.follow_clamps) {
    EngineOptions followed = options;
    followed.links.world_frame = survey.world;
    followed.links.constants = survey.constants;
    survey.clamps = FollowClamps(bags, survey.from, survey.to, inputs->vehicle,
                                 inputs->cables.cables, followed);
    for (const ClampJudge& clamps : survey.clamps)
      for (Finding& finding : clamps.Report()) survey.findings.push_back(std::move(finding));
    for (Finding& finding : survey.findings) finding.start = links.Start();
  }
  inputs->survey = std::move(survey);
}

}  // namespace

void AddReads(const InputPaths& paths, PlannedOutputs* outputs) {
  for (const std::string& file : FilesRead(paths, {})) outputs->Reads(file);
}

std::vector<std::string> FilesRead(const InputPaths& paths, const Inputs& inputs) {
  std::vector<std::string> files = {paths.vehicle, paths.cables};
  for (const std::string& section : paths.sections)
    files.push_back(section.substr(section.find('=') + 1));
  files.insert(files.end(), paths.bags.begin(), paths.bags.end());
  files.insert(files.end(), inputs.vehicle.mesh_files.begin(), inputs.vehicle.mesh_files.end());
  return files;
}

VehicleModel LoadVehicleOf(const CableFile& cables, const std::string& path, Problems* problems) {
  std::set<std::string> collision, visual;
  for (const CableModel& cable : cables.cables) {
    for (const std::string& link : cable.avoid)
      (cable.avoid_visual.count(link) > 0 ? visual : collision).insert(link);
  }
  VehicleUse use;
  use.visual_links = {visual.begin(), visual.end()};
  use.moving_links = NeededLinks(cables.cables);
  const std::string folder = std::filesystem::absolute(path).parent_path().string();
  return LoadVehicle(path, {collision.begin(), collision.end()}, FindPackagesFrom(folder), problems,
                     use);
}

Inputs LoadInputs(const InputPaths& paths, const EngineOptions& options, Problems* problems) {
  Inputs inputs;
  for (const std::string& problem : options.Check()) problems->Add("", problem);
  CheckSeconds(paths.start, "start", "", problems);
  CheckSeconds(paths.duration, "duration", " (0: to the recording's end)", problems);

  Problems cable_problems;
  inputs.cables = LoadCableFile(paths.cables, &cable_problems, paths.sections);
  Problems vehicle_problems;
  inputs.vehicle = LoadVehicleOf(inputs.cables, paths.vehicle, &vehicle_problems);
  if (!inputs.vehicle.links.empty()) {
    CheckAgainstVehicle(inputs.cables, inputs.vehicle.links, &cable_problems);
    CheckAvoidedLinks(inputs.cables, inputs.vehicle, paths.vehicle, &cable_problems);
    cable_problems.SortByLine();
  }
  for (const std::string& joint : options.links.held_joints) {
    if (vehicle_problems.empty() && inputs.vehicle.FindJoint(joint) == nullptr) {
      vehicle_problems.Add(paths.vehicle, 0, "hold",
                           "the vehicle has no joint '" + joint + "' to hold");
    }
  }
  for (const auto* geometry : {&inputs.vehicle.collision, &inputs.vehicle.visual}) {
    for (const auto& [link, shapes] : *geometry) {
      for (const Shape& shape : shapes) {
        if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
          inputs.triangles += static_cast<int>(mesh->triangles.size());
        }
      }
    }
  }

  if (problems->empty() && vehicle_problems.empty())
    inputs.bodies = MakeBodies(inputs.vehicle, options.threads);

  Problems bag_problems;
  inputs.bags = std::make_unique<BagReader>(paths.bags, &bag_problems, options.links.topics);
  const bool usable = bag_problems.empty() && !paths.bags.empty();
  if (usable && inputs.bags->count() == 0) {
    const MotionTopics& topics = options.links.topics;
    bag_problems.Add(Join(paths.bags), "has neither " + topics.tf + " nor " + topics.joint_states +
                                           ": nothing moves the vehicle");
    for (const std::string& topic : UnreadMotion(inputs.bags->contents(), topics))
      bag_problems.Add(Join(paths.bags), topic);
  } else if (usable && problems->empty() && cable_problems.empty() && vehicle_problems.empty()) {
    try {
      CheckRecording(paths, options, &inputs, &bag_problems);
    } catch (const std::exception& error) {
      bag_problems.Add(Join(paths.bags), std::string("damaged: ") + error.what());
    }
  }
  problems->Append(cable_problems);
  problems->Append(vehicle_problems);
  problems->Append(bag_problems);
  return inputs;
}

}  // namespace cosserat_cable
