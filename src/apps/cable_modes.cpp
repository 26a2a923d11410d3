// The natural modes of cables at rest: frequencies, damping ratios, shapes.
#include "cosserat_cable/ros/modes_run.h"
#include "engine_arguments.h"

int main(int argc, char** argv) {
  cosserat_cable::ModesOptions options;
  CLI::App app(
      "Finds the natural modes of a vehicle's cables at rest, joints at zero and gravity along -z "
      "of its root; or of a specimen between two clamps.");
  app.add_option("cables", options.cables, "YAML file of the cables")->required();
  app.add_option("--vehicle", options.vehicle, "URDF file of the vehicle; not for a specimen");
  app.add_option("--a", options.a, "pose of a specimen's clamp a: \"x,y,z,qx,qy,qz,qw\"");
  app.add_option("--b", options.b, "of clamp b");
  app.add_option("--count", options.count, "modes of each cable")->capture_default_str();
  app.add_option("--output", options.output,
                 "folder for modes.json, NAME.csv (shapes) and cables.yaml; scripts/plot_modes "
                 "draws it");
  app.add_option("--json", options.json, "file for the numbers");
  int code = 0;
  if (!cosserat_cable::Parse(&app, argc, argv, &code)) return code;
  return cosserat_cable::RunModes(options);
}
