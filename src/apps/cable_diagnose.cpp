// What a simulation gets wrong in a measurement set, and why.
#include <filesystem>

#include "cosserat_cable/console/run_tool.h"
#include "cosserat_cable/diagnosis/diagnose_run.h"
#include "parse_arguments.h"

namespace {

using cosserat_cable::NumberSpec;

int Run(int argc, char** argv) {
  cosserat_cable::DiagnoseRunOptions options;
  // Scripts stand beside this program where it is installed, and where it was built from.
  const std::filesystem::path beside =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "diagnosis_report";
  options.report_program = std::filesystem::exists(beside) ? beside.string()
                                                           : COSSERAT_CABLE_SCRIPTS
                               "/diagnosis_report";
  CLI::App app(
      "Shows what a recalibrated Kelvin-Voigt cable gets wrong in a measurement set, names the "
      "cause where the records tell it, and writes the extended cable and what it gains.");
  app.add_option("set", options.set, "folder of the measurement set")
      ->required()
      ->check(cosserat_cable::FilledPath());
  app.add_option("--output", options.output,
                 "folder for verdict.json, extended_cable.yaml, extended_measurement.yaml, fit/ "
                 "and report.html")
      ->required()
      ->check(cosserat_cable::FilledPath());
  app.add_option("--time-budget,--time-limit", options.time_budget,
                 "causes that are not fitted by then stay so [s]")
      ->check(cosserat_cable::Within(NumberSpec::Above(0, "s").AtMost(1e7)))
      ->capture_default_str();
  app.add_flag("!--no-advice", options.advise,
               "do not look for the experiment that would tell rivals apart");
  app.add_flag("!--no-report", options.report, "leave out report.html");
  app.add_option("--json", options.json, "another file for the numbers of verdict.json")
      ->check(cosserat_cable::FilledPath());
  int code = 0;
  if (!cosserat_cable::Parse(&app, argc, argv, &code)) return code;
  return cosserat_cable::RunDiagnose(options);
}

}  // namespace

int main(int argc, char** argv) {
  return cosserat_cable::RunTool([&] { return Run(argc, argv); });
}
