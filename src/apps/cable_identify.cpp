// Parameters of a cable from a measurement set.
#include <filesystem>

#include "cosserat_cable/console/run_tool.h"
#include "cosserat_cable/identification/identify_run.h"
#include "parse_arguments.h"

namespace {

using cosserat_cable::NumberSpec;
using cosserat_cable::Within;

int Run(int argc, char** argv) {
  cosserat_cable::IdentifyRunOptions options;
  // Scripts stand beside this program where it is installed, and where it was built from.
  const std::filesystem::path beside =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "identification_report";
  options.report_program = std::filesystem::exists(beside) ? beside.string()
                                                           : COSSERAT_CABLE_SCRIPTS
                               "/identification_report";
  CLI::App app(
      "Fits the cable's parameters to all records of a measurement set at once, through the "
      "simulation, and says how well the data determine them.");
  app.add_option("set", options.set, "folder of the measurement set")
      ->required()
      ->check(cosserat_cable::FilledPath());
  app.add_option("--output", options.output,
                 "folder for identified_cable.yaml, identification.json, fit/ and report.html")
      ->required()
      ->check(cosserat_cable::FilledPath());
  app.add_option("--uncertain-clamp", options.unknowns.clamp_sd,
                 "clamp a points elsewhere than the set says, by about this angle [rad]: estimate "
                 "it with the parameters")
      ->check(Within(NumberSpec::AtLeast(0, "rad").AtMost(1)));
  app.add_option("--uncertain-length", options.unknowns.length_sd,
                 "free lengths are wrong by about this [m]: estimate them with the parameters")
      ->check(Within(NumberSpec::AtLeast(0, "m").AtMost(1)));
  app.add_option("--time-budget,--time-limit", options.time_budget,
                 "end with what was found when the fit has taken this long [s]; 0: when it is done")
      ->check(Within(NumberSpec::AtLeast(0, "s").AtMost(1e7)))
      ->capture_default_str();
  app.add_flag("--use-damaged", options.use_damaged,
               "use what is left of records that are clipped, frozen, gappy or shorter than a "
               "period; otherwise they count for nothing");
  app.add_flag("!--no-end-damping", options.unknowns.end_damping,
               "take the loss D_E at a disc for zero instead of estimating it");
  app.add_flag("!--no-profiles", options.profiles,
               "leave out the profiles of the likelihood: intervals from the curvature alone");
  app.add_flag("!--no-slips", options.slips,
               "leave out the search for channels that were recorded otherwise than the set says");
  app.add_flag("!--no-direct", options.direct,
               "leave out the evaluation from frequencies and decay rates alone");
  auto* plan =
      app.add_flag("--plan", options.plan, "say what to measure next: lengths, disc, repeats");
  app.add_option("--plan-for", options.plan_options.target,
                 "the parameter that is to be known better; default: the one known worst")
      ->needs(plan);
  app.add_option("--plan-accuracy", options.plan_options.accuracy,
                 "half of its 95 % interval, relative")
      ->needs(plan)
      ->check(Within(NumberSpec::AtLeast(1e-4, "").AtMost(10)))
      ->capture_default_str();
  app.add_option("--plan-longest", options.plan_options.longest,
                 "the longest specimen that there is room for [m]; default: the set's longest")
      ->needs(plan)
      ->check(Within(NumberSpec::Above(0, "m").AtMost(20)));
  app.add_option("--plan-shortest", options.plan_options.shortest,
                 "the shortest [m]; default: the set's shortest")
      ->needs(plan)
      ->check(Within(NumberSpec::Above(0, "m").AtMost(20)));
  app.add_flag("!--no-report", options.report, "leave out report.html");
  app.add_flag("--pdf", options.pdf, "write report.pdf too");
  app.add_option("--json", options.json, "another file for the numbers of identification.json")
      ->check(cosserat_cable::FilledPath());
  int code = 0;
  if (!cosserat_cable::Parse(&app, argc, argv, &code)) return code;
  return cosserat_cable::RunIdentify(options);
}

}  // namespace

int main(int argc, char** argv) {
  return cosserat_cable::RunTool([&] { return Run(argc, argv); });
}
