// Replays a recording through the cables, without a master, into a bag.
#include <algorithm>

#include "cosserat_cable/console/run_tool.h"
#include "cosserat_cable/ros/replay.h"
#include "cosserat_cable/ros/resume.h"
#include "engine_arguments.h"

namespace {

constexpr const char* kResume = "--resume-dump";
constexpr const char* kResumeHelp =
    "NAME_STAMP.failed.yaml, as it is written where a cable fails: does once more what failed, "
    "instead of a replay; goes with --vehicle only, which is the run's by default";

int Resume(int argc, char** argv) {
  std::string dump, vehicle;
  CLI::App app("Repeats the failure of a cable from the state that was written when it failed.");
  app.add_option(kResume, dump, kResumeHelp)->required()->check(cosserat_cable::FilledPath());
  app.add_option("--vehicle", vehicle, "URDF file of the vehicle")
      ->check(cosserat_cable::FilledPath());
  int code = 0;
  if (!cosserat_cable::Parse(&app, argc, argv, &code)) return code;
  return cosserat_cable::ResumeDump(dump, vehicle);
}

int Run(int argc, char** argv) {
  if (std::any_of(argv, argv + argc,
                  [](const std::string& argument) { return argument.rfind(kResume, 0) == 0; }))
    return Resume(argc, argv);
  cosserat_cable::ReplayOptions options;
  cosserat_cable::EngineOptions& engine = options.engine;
  CLI::App app("Replays recorded link motion through a vehicle's cables, into a bag.");
  cosserat_cable::AddInputArguments(&app, &options.inputs, &engine);
  app.add_option("--output", options.output, "bag to be written")
      ->required()
      ->check(cosserat_cable::FilledPath());
  app.add_option("--json", options.json, "file for the summary's numbers")
      ->check(cosserat_cable::FilledPath());
  app.add_option("--dt", engine.dt, "time step [s]")->capture_default_str();
  app.add_option("--threads", engine.threads, "0: one per core; the results are the same")
      ->capture_default_str();
  app.add_option("--telemetry-rate", engine.telemetry_rate, "[Hz]")->capture_default_str();
  app.add_option("--marker-rate", engine.marker_rate, "[Hz]; 0: none")->capture_default_str();
  app.add_option("--amplitude-window", engine.amplitude_window, "[s]")->capture_default_str();
  app.add_option("--amplitude-frame", engine.amplitude_frame, "axes of the amplitude")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, cosserat_cable::AmplitudeFrame>{
              {"reference", cosserat_cable::AmplitudeFrame::kReference},
              {"world", cosserat_cable::AmplitudeFrame::kWorld}},
          CLI::ignore_case));
  app.add_option("--curvature-scale", engine.markers.curvature_scale,
                 "curvature at the colours' end [1/m]; 0: 1 / (5 diameters)")
      ->capture_default_str();
  std::string dump;  // never given here
  app.add_option(kResume, dump, kResumeHelp);
  int code = 0;
  if (!cosserat_cable::Parse(&app, argc, argv, &code)) return code;
  return cosserat_cable::RunReplay(std::move(options));
}

}  // namespace

int main(int argc, char** argv) {
  return cosserat_cable::RunTool([&] { return Run(argc, argv); });
}
