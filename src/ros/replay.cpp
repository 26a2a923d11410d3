#include "cosserat_cable/ros/replay.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>

#include "bag_file.h"
#include "cosserat_cable/console/interrupt.h"
#include "cosserat_cable/console/planned_outputs.h"
#include "cosserat_cable/console/progress.h"
#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/ros/bag_sink.h"
#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;

fs::path FolderOf(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

// The effective configuration, beside the bag.
std::string ConfigurationOf(const std::string& output) {
  return (fs::path(output).parent_path() / fs::path(output).stem()).string() + ".cables.yaml";
}

PlannedOutputs CheckOutputs(const ReplayOptions& options, Problems* problems) {
  if (options.inputs.bags.empty()) problems->Add("", 0, "bag", "no recording is given");
  PlannedOutputs outputs;
  AddReads(options.inputs, &outputs);
  outputs.WritesFile(options.output, "output");
  outputs.WritesFile(ConfigurationOf(options.output), "output");
  outputs.WritesFile(options.json, "json");
  outputs.Check(problems);
  return outputs;
}

void Say(CableEngine* engine) {
  for (const std::string& news : engine->TakeNews()) {
    std::cerr << (isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "") << news << "\n";
  }
}

// What the cable file has no keys for, as comments.
std::string ConfigurationHead(const ReplayOptions& options, const BagSurvey& survey) {
  return "# " + GravityText(options.engine.gravity_W, survey.world) + "\n# cable_replay" +
         SharedOptionsText(options.engine) + "\n";
}

// So much of the recording is read before the cables follow: their threads then have enough to do
// [ns]. Less where time runs backwards or jumps, for what is not simulated by then is lost.
constexpr std::int64_t kReadAhead = 200'000'000;

// By how much a message's stamps are off the latest of all before, either way [ns].
std::int64_t Jump(const BagMessage& message, std::int64_t latest) {
  if (latest == 0) return 0;
  if (message.joints) return std::abs(ToNanoseconds(message.joints->header.stamp) - latest);
  std::int64_t jump = 0;
  if (message.tf && !message.is_static)
    for (const auto& transform : message.tf->transforms)
      jump = std::max(jump, std::abs(ToNanoseconds(transform.header.stamp) - latest));
  return jump;
}

// Feeds the recording through the engine into the bag; false where it was interrupted.
bool Simulate(const Inputs& inputs, CableEngine* engine, BagSink* sink) {
  const BagSurvey& survey = *inputs.survey;
  const std::int64_t end = std::min(survey.to, inputs.bags->end_time());
  const double duration = static_cast<double>(end - survey.first_step) * 1e-9;
  Progress progress(duration, "s simulated");
  const auto advance = [&] {
    engine->Advance(sink, Interrupted);
    Say(engine);
    // Stamps may jump to where no recording goes.
    progress.Update(
        std::min(static_cast<double>(engine->now() - survey.first_step) * 1e-9, duration));
  };
  std::int64_t advance_at = survey.from + kReadAhead;
  inputs.bags->ForEach(survey.from, survey.to, [&](BagMessage message) {
    if (message.time >= advance_at || Jump(message, engine->links().last_stamp()) > kReadAhead) {
      advance();
      advance_at = message.time + kReadAhead;
    }
    if (message.tf)
      engine->Ingest(*message.tf, message.is_static, message.publisher(), message.time);
    if (message.joints) engine->Ingest(*message.joints, message.publisher(), message.time);
    sink->Copy(std::move(message));
    return !Interrupted();
  });
  if (!Interrupted()) {
    engine->Finish();
    advance();
  }
  sink->Flush();
  return !Interrupted();
}

}  // namespace

ExitCode RunReplay(ReplayOptions options) {
  const auto start = std::chrono::steady_clock::now();
  Problems problems;
  PlannedOutputs outputs = CheckOutputs(options, &problems);
  options.engine.ApplyGravity(&problems);
  Inputs inputs = LoadInputs(options.inputs, options.engine, &problems);
  outputs.CheckReads(inputs.vehicle.mesh_files, &problems);
  if (problems.empty())
    for (const Finding& finding : inputs.survey->findings)
      if (finding.kind == "one_instant") problems.Add("", finding.ToString());
  if (!problems.empty()) {
    std::cerr << problems.ToString();
    return kExitBadInput;
  }
  CatchInterrupts();
  options.engine.links.world_frame = inputs.survey->world;
  options.engine.links.constants = inputs.survey->constants;
  // The whole recording was judged by now, with what is above the inertial frame.
  options.engine.links.judge = false;
  options.engine.known = inputs.survey->findings;
  options.engine.dump_directory = FolderOf(options.output).string();
  options.engine.vehicle_file = fs::absolute(options.inputs.vehicle).string();
  if (!inputs.survey->world_is_recorded) {
    std::cerr << "no frame above the vehicle is recorded: its root '" << inputs.survey->world
              << "' is taken as inertial\n";
  }
  if (!inputs.survey->topmost.empty()) {
    std::cerr << "'" << inputs.survey->world << "' is taken as inertial, not '"
              << inputs.survey->topmost << "' above it: a localisation's corrections move it\n";
  }

  // Before anybody waits for it.
  for (const Finding& finding : inputs.survey->findings)
    if (finding.kind == "limits_the_run") std::cerr << "warning: " << finding.ToString() << "\n";

  CableEngine engine(inputs.vehicle, inputs.bodies, inputs.cables.cables, options.engine);
  ExitCode code = kExitDone;
  try {
    BagWriter writer(options.output);
    BagSink sink(&writer, inputs.survey->from);
    try {
      if (!Simulate(inputs, &engine, &sink)) {
        std::cerr << "interrupted: what was simulated so far is kept in " << options.output << "\n";
        code = kExitInterrupted;
      }
    } catch (const BagWriteError& error) {
      std::cerr << error.what() << ": stopped; what was written so far is kept\n";
      code = kExitFileTrouble;
    } catch (const BagFormatError& error) {
      std::cerr << "the recording cannot be read on: " << error.what() << "\n";
      code = kExitFileTrouble;
    }
    writer.Close();
    const std::string configuration = ConfigurationOf(options.output);
    if (!WriteTextFile(configuration, ConfigurationHead(options, *inputs.survey) +
                                          WriteCableFile(inputs.cables))) {
      std::cerr << configuration << ": could not be written\n";
      code = kExitFileTrouble;
    }
  } catch (const BagWriteError& error) {
    std::cerr << error.what() << "\n";
    return kExitFileTrouble;
  }

  Summary summary = engine.MakeSummary();
  summary.notes = Notes(inputs);
  for (const Problem& warning : inputs.vehicle.warnings.all())
    summary.warning_sentences.push_back(warning.ToString());
  summary.wall_time =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  summary.peak_memory = PeakMemory();
  std::cout << summary.ToText();
  if (!options.json.empty() && !WriteTextFile(options.json, summary.ToJson())) {
    std::cerr << options.json << ": could not be written\n";
    code = kExitFileTrouble;
  }
  if (code == kExitDone && engine.AnyFailed()) code = kExitFailed;
  return code;
}

}  // namespace cosserat_cable
