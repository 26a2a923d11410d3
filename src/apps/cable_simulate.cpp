// Every experiment of a measurement set, simulated with a cable.
#include "cosserat_cable/console/run_tool.h"
#include "cosserat_cable/identification/simulate_run.h"
#include "parse_arguments.h"

namespace {

int Run(int argc, char** argv) {
  cosserat_cable::SimulateRunOptions options;
  CLI::App app(
      "Simulates every experiment of a measurement set with the set's own cable, or with another "
      "one, and writes what its channels would have shown.");
  app.add_option("set", options.set, "folder of the measurement set")
      ->required()
      ->check(cosserat_cable::FilledPath());
  app.add_option("--cable", options.cable,
                 "YAML file of a cable: stiffness, damping and extensions are its own, length, "
                 "masses and clamps the set's")
      ->check(cosserat_cable::FilledPath());
  app.add_option("--output", options.output,
                 "folder for NAME.csv, one per experiment, in the record's columns and times")
      ->required()
      ->check(cosserat_cable::FilledPath());
  app.add_option("--dt", options.dt, "step [s]")->capture_default_str();
  app.add_option("--elements", options.elements,
                 "elements of the cable; default: as its file says");
  app.add_flag("--plain", options.plain,
               "one run only: without the comparison with a coarser one that takes out the steps' "
               "errors");
  app.add_flag("--rms", options.rms, "compare with the records");
  app.add_option("--json", options.json, "file for the numbers")
      ->check(cosserat_cable::FilledPath());
  int code = 0;
  if (!cosserat_cable::Parse(&app, argc, argv, &code)) return code;
  return cosserat_cable::RunSimulate(options);
}

}  // namespace

int main(int argc, char** argv) {
  return cosserat_cable::RunTool([&] { return Run(argc, argv); });
}
