// Says all that is wrong with a vehicle, its cables and a recording; simulates nothing.
#include <iostream>

#include "cosserat_cable/console/exit_code.h"
#include "cosserat_cable/console/run_tool.h"
#include "cosserat_cable/ros/clamp_motions.h"
#include "cosserat_cable/ros/summary.h"
#include "engine_arguments.h"

namespace {

int Run(int argc, char** argv) {
  cosserat_cable::InputPaths paths;
  cosserat_cable::EngineOptions engine;
  std::string json, clamps;
  CLI::App app("Checks a vehicle, its cables and a recording, and simulates nothing.");
  cosserat_cable::AddInputArguments(&app, &paths, &engine);
  app.add_option("--json", json, "file for what is printed")->check(cosserat_cable::FilledPath());
  app.add_option("--clamps", clamps,
                 "folder for where the recording moves each cable's clamps, in the inertial frame: "
                 "motion files of a measurement set, NAME_a.csv and NAME_b.csv")
      ->check(cosserat_cable::FilledPath());
  int code = 0;
  if (!cosserat_cable::Parse(&app, argc, argv, &code)) return code;

  paths.follow_clamps = true;

  cosserat_cable::Problems problems;
  cosserat_cable::PlannedOutputs outputs;
  cosserat_cable::AddReads(paths, &outputs);
  outputs.WritesFile(json, "json");
  outputs.WritesFolder(clamps, "clamps", {});
  outputs.Check(&problems);
  if (!problems.empty()) json.clear();
  engine.ApplyGravity(&problems);
  const cosserat_cable::Inputs inputs = cosserat_cable::LoadInputs(paths, engine, &problems);
  cosserat_cable::Problems lost;
  outputs.WritesFolder(clamps, "clamps", cosserat_cable::ClampMotionFiles(inputs));
  outputs.CheckReads(cosserat_cable::FilesRead(paths, inputs), &lost);
  if (!lost.empty()) json.clear();
  problems.Append(lost);
  if (!json.empty() && !cosserat_cable::WriteTextFile(
                           json, cosserat_cable::DescribeJson(inputs, engine, problems))) {
    std::cerr << json << ": could not be written\n";
    return cosserat_cable::kExitFileTrouble;
  }
  if (!problems.empty()) {
    std::cerr << problems.ToString();
    return cosserat_cable::kExitBadInput;
  }
  if (!clamps.empty() && !inputs.survey) {
    std::cerr << "clamps: got no recording, expected one (--bag) that moves the vehicle\n";
    return cosserat_cable::kExitBadInput;
  }
  if (!clamps.empty()) {
    try {
      cosserat_cable::WriteClampMotions(inputs, engine, clamps);
    } catch (const std::exception& error) {
      std::cerr << clamps << ": " << error.what() << "\n";
      return cosserat_cable::kExitFileTrouble;
    }
  }
  const std::size_t findings = cosserat_cable::InputWarnings(inputs).size() +
                               (inputs.survey ? inputs.survey->findings.size() : 0);
  std::cout << cosserat_cable::Describe(inputs, engine) << "ok";
  if (findings > 0)
    std::cout << ", but for " << findings << (findings == 1 ? " warning" : " warnings");
  std::cout << "\n";
  return cosserat_cable::kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  return cosserat_cable::RunTool([&] { return Run(argc, argv); });
}
