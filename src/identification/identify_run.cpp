#include "cosserat_cable/identification/identify_run.h"

#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "answer.h"
#include "cosserat_cable/console/interrupt.h"
#include "cosserat_cable/console/output_file.h"
#include "cosserat_cable/console/planned_outputs.h"
#include "cosserat_cable/console/progress.h"
#include "cosserat_cable/console/run_program.h"
#include "cosserat_cable/identification/direct_evaluation.h"
#include "cosserat_cable/identification/estimation.h"
#include "cosserat_cable/identification/identified_cable.h"
#include "plan_answer.h"
#include "stage_clock.h"

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;

void CheckOutputs(const IdentifyRunOptions& options, const MeasurementSet& set,
                  Problems* problems) {
  PlannedOutputs outputs;
  for (const std::string& file : FilesOf(set)) outputs.Reads(file);
  std::vector<std::string> files = {"identified_cable.yaml", "identification.json", "report.html"};
  for (const Experiment& experiment : set.experiments)
    files.push_back("fit/" + experiment.name + ".csv");
  outputs.WritesFolder(options.output, "output", files);
  outputs.WritesFile(options.json, "json");
  outputs.Check(problems);
}

/// With the times so far.
void WriteNumbers(const IdentifyRunOptions& options, const StageClock& clock,
                  nlohmann::json* answer) {
  TellTimes(clock.seconds(), clock.stages(), answer);
  const std::string text = answer->dump(2) + "\n";
  WriteWhole((fs::path(options.output) / "identification.json").string(), text);
  if (!options.json.empty()) WriteWhole(options.json, text);
}

/// What `write` cannot write is told.
ExitCode Written(const std::function<void()>& write) {
  try {
    write();
    return kExitDone;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return kExitFileTrouble;
  }
}

}  // namespace

ExitCode RunIdentify(const IdentifyRunOptions& options) {
  StageClock clock;
  Problems problems, warnings;
  const MeasurementSet set = LoadMeasurementSet(options.set, &problems);
  if (problems.empty()) CheckPlausibility(set, &problems, &warnings);
  CheckOutputs(options, set, &problems);
  const auto refuse = [&] {
    problems.SortByLine();
    std::cerr << problems.ToString();
    return kExitBadInput;
  };
  if (!problems.empty()) return refuse();

  clock.Charge("reading");
  CatchInterrupts();
  EstimationOptions estimation_options;
  estimation_options.unknowns = options.unknowns;
  estimation_options.profiles = options.profiles;
  estimation_options.use_damaged = options.use_damaged;
  estimation_options.slips = options.slips;
  Estimation estimation;
  DirectEvaluation direct;
  Plan plan;
  {
    Progress progress(100, "%");
    estimation_options.progress = [&](const std::string& what, double part) {
      progress.Update(100 * part, what);
      return !Interrupted();
    };
    estimation_options.stop = Interrupted;
    estimation_options.time_budget = options.time_budget;
    if (options.direct) {
      progress.Update(0, "frequencies and decay rates");
      direct = EvaluateDirectly(set);
      for (const auto& [name, value] : direct.values)
        estimation_options.guesses.push_back({name, value.value});
      clock.Charge("frequencies and decay rates");
    }
    estimation = Estimate(set, estimation_options, &problems);
    clock.Charge(estimation.stages);
    if (options.plan && estimation.ok && !Interrupted()) {
      plan = MakePlan(set, estimation, options.plan_options, estimation_options.progress);
      clock.Charge("plan");
    }
  }
  if (!problems.empty()) return refuse();
  if (!estimation.ok) {
    std::cerr << (estimation.interrupted
                      ? "interrupted before anything was found: nothing was written"
                      : estimation.message)
              << "\n";
    return estimation.interrupted ? kExitInterrupted : kExitFailed;
  }
  for (const Problem& warning : warnings.all()) estimation.warnings.push_back(warning.ToString());
  for (const ParameterEstimate& one : estimation.parameters) {
    if (!options.direct || !one.determined) continue;
    const std::string text = DisagreementOf(direct, one.unknown.name, one.low, one.high);
    if (!text.empty()) estimation.warnings.push_back(text);
  }

  nlohmann::json answer = AnswerJson(set, estimation);
  if (options.direct) answer["direct"] = ToJson(direct);
  if (options.plan) answer["plan"] = PlanJson(plan);
  const ExitCode written = Written([&] {
    const fs::path folder(options.output);
    fs::create_directories(folder / "fit");
    for (std::size_t e = 0; e < set.experiments.size(); ++e)
      WriteWhole((folder / "fit" / (set.experiments[e].name + ".csv")).string(),
                 FitCsv(set.experiments[e], estimation.experiments[e]));
    WriteWhole((folder / "identified_cable.yaml").string(), IdentifiedCableText(set, estimation));
    clock.Charge("writing");
    WriteNumbers(options, clock, &answer);
  });
  if (written != kExitDone) return written;
  std::cout << AnswerTable(set, estimation);
  if (options.plan) std::cout << PlanTable(plan);
  for (const std::string& warning : estimation.warnings)
    std::cerr << "warning: " << warning << "\n";
  std::printf("identified in %.1f s\n", clock.seconds());
  std::fflush(stdout);  // before the report's program speaks
  if (estimation.interrupted) {
    std::cerr << options.output << ": interrupted: what was found so far was written\n";
    return kExitInterrupted;
  }
  if (!options.report) return kExitDone;
  std::vector<std::string> report = {options.report_program, options.output};
  if (options.pdf) report.push_back("--pdf");
  if (!RunProgram(report)) {
    std::cerr << options.output << "/report.html: could not be written; the numbers are there\n";
    return kExitFileTrouble;
  }
  clock.Charge("report");
  std::printf("with its report in %.1f s\n", clock.seconds());
  return Written([&] { WriteNumbers(options, clock, &answer); });
}

}  // namespace cosserat_cable
