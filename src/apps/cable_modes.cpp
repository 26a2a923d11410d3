// The natural modes of cables at rest: frequencies, damping ratios, shapes.
#include "cosserat_cable/console/run_tool.h"
#include "cosserat_cable/ros/modes_run.h"
#include "engine_arguments.h"

namespace {

int Run(int argc, char** argv) {
  cosserat_cable::ModesOptions options;
  CLI::App app(
      "Finds the natural modes of a vehicle's cables at rest, where its joints stand or where a "
      "recording has it; or of a specimen between two clamps.");
  app.add_option("cables", options.cables, "YAML file of the cables")
      ->required()
      ->check(cosserat_cable::FilledPath());
  app.add_option("--section", options.sections,
                 "[NAME=]FILE, may be repeated: a vehicle's cables have the section of a specimen")
      ->allow_extra_args(false)
      ->check(cosserat_cable::FilledPath());
  app.add_option("--vehicle", options.vehicle, "URDF file of the vehicle; not for a specimen")
      ->check(cosserat_cable::FilledPath());
  app.add_option("--a", options.a, "pose of a specimen's clamp a: \"x,y,z,qx,qy,qz,qw\"");
  app.add_option("--b", options.b, "of clamp b");
  // One value each time: what follows may be the file of the cables.
  app.add_option("--joints", options.joints,
                 "NAME=VALUE,... [rad] or [m], may be repeated; other joints are at zero, or at "
                 "the end of their limits that is nearest to it; in the vehicle's root")
      ->allow_extra_args(false);
  app.add_option("--bag", options.bags,
                 "recording, may be repeated: the vehicle is where it has it at --time")
      ->allow_extra_args(false)
      ->check(cosserat_cable::FilledPath());
  app.add_option("--time", options.time, "after the recording's first sample [s]");
  cosserat_cable::AddSharedArguments(&app, &options.engine);
  app.add_option("--count", options.count, "modes of each cable")->capture_default_str();
  app.add_option(
         "--output", options.output,
         "folder for modes.json, NAME.csv (shapes) and cables.yaml; scripts/plot_modes draws it")
      ->check(cosserat_cable::FilledPath());
  app.add_option("--json", options.json, "file for the numbers")
      ->check(cosserat_cable::FilledPath());
  int code = 0;
  if (!cosserat_cable::Parse(&app, argc, argv, &code)) return code;
  return cosserat_cable::RunModes(std::move(options));
}

}  // namespace

int main(int argc, char** argv) {
  return cosserat_cable::RunTool([&] { return Run(argc, argv); });
}
