#include "cosserat_cable/diagnosis/diagnose_run.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "cosserat_cable/console/interrupt.h"
#include "cosserat_cable/console/output_file.h"
#include "cosserat_cable/console/planned_outputs.h"
#include "cosserat_cable/console/progress.h"
#include "cosserat_cable/console/run_program.h"
#include "cosserat_cable/diagnosis/diagnosis.h"
#include "verdict_json.h"

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;

/// The whole set, with what was found filled in: a file beside the verdict, its records below.
void WriteExtendedSet(const MeasurementSet& extended, const fs::path& folder) {
  MeasurementSet set = extended;
  const auto below = [](std::string* file) {
    if (!file->empty()) *file = "records/" + fs::path(*file).filename().string();
  };
  for (Experiment& experiment : set.experiments) {
    experiment.record.file = experiment.name + ".csv";
    below(&experiment.record.file);
    below(&experiment.load.file);
    for (auto* motion : {&experiment.a.motion, &experiment.b.motion})
      if (*motion) below(&(*motion)->file);
  }
  WriteMeasurementSet(set, folder.string());
  fs::rename(folder / "measurement.yaml", folder / kExtendedMeasurement);
}

void CheckOutputs(const DiagnoseRunOptions& options, const MeasurementSet& set,
                  Problems* problems) {
  PlannedOutputs outputs;
  for (const std::string& file : FilesOf(set)) outputs.Reads(file);
  std::vector<std::string> files = {"verdict.json",    "fits.json",   kBaselineCable,
                                    kExtendedCable,    "report.html", kExtendedMeasurement,
                                    "measurement.yaml"};
  for (const Experiment& experiment : set.experiments) {
    files.push_back("fit/" + experiment.name + ".csv");
    files.push_back("records/" + experiment.name + ".csv");
  }
  outputs.WritesFolder(options.output, "output", files);
  outputs.WritesFile(options.json, "json");
  outputs.Check(problems);
}

}  // namespace

ExitCode RunDiagnose(const DiagnoseRunOptions& options) {
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
  const fs::path folder(options.output);
  std::error_code error;
  if (fs::exists(folder / "measurement.yaml", error)) {
    std::cerr << options.output << ": got the folder of a measurement set, expected another one "
              << "for the output\n";
    return kExitBadInput;
  }
  fs::create_directories(folder / "fit", error);
  if (error) {
    std::cerr << options.output << ": " << error.message() << "\n";
    return kExitFileTrouble;
  }

  CatchInterrupts();
  DiagnosisOptions diagnosis_options;
  diagnosis_options.time_budget = options.time_budget;
  diagnosis_options.advise = options.advise;
  diagnosis_options.memory = (folder / "fits.json").string();
  diagnosis_options.stop = Interrupted;
  Diagnosis diagnosis;
  try {
    Progress progress(100, "%");
    diagnosis_options.progress = [&](const std::string& what, double part) {
      progress.Update(100 * part, what);
      return !Interrupted();
    };
    diagnosis = Diagnose(set, diagnosis_options, &problems);
  } catch (const std::runtime_error& failure) {
    std::cerr << failure.what() << "\n";
    return kExitFileTrouble;
  }
  if (!problems.empty()) return refuse();
  if (!diagnosis.ok) {
    std::cerr << (diagnosis.interrupted
                      ? "interrupted before anything was found: nothing was written"
                      : diagnosis.message)
              << "\n";
    return diagnosis.interrupted ? kExitInterrupted : kExitFailed;
  }
  for (const Problem& warning : warnings.all()) diagnosis.warnings.push_back(warning.ToString());
  const std::string verdict = VerdictJson(set, diagnosis).dump(2) + "\n";
  try {
    for (const char* stale : {kExtendedCable, kExtendedMeasurement}) fs::remove(folder / stale);
    for (const Experiment& experiment : set.experiments)
      for (const RecordView& view : diagnosis.records)
        if (view.experiment == experiment.name)
          WriteWhole((folder / "fit" / (experiment.name + ".csv")).string(),
                     FitCsv(experiment, view));
    WriteWhole((folder / kBaselineCable).string(),
               FoundCableText(set, diagnosis.baseline_cable, diagnosis.baseline));
    if (diagnosis.has_extended) {
      WriteWhole((folder / kExtendedCable).string(),
                 FoundCableText(set, diagnosis.extended_set.cable, diagnosis.extended));
      WriteExtendedSet(diagnosis.extended_set, folder);
    }
    WriteWhole((folder / "verdict.json").string(), verdict);
    if (!options.json.empty()) WriteWhole(options.json, verdict);
  } catch (const std::exception& failure) {
    std::cerr << failure.what() << "\n";
    return kExitFileTrouble;
  }
  std::cout << VerdictTable(diagnosis);
  for (const std::string& warning : diagnosis.warnings) std::cerr << "warning: " << warning << "\n";
  std::printf("diagnosed in %.1f s\n", diagnosis.seconds);
  if (diagnosis.interrupted) {
    std::cerr << options.output << ": interrupted: what was found so far was written; "
              << "the same command goes on from there\n";
    return kExitInterrupted;
  }
  if (!options.report) return kExitDone;
  if (RunProgram({options.report_program, options.output})) return kExitDone;
  std::cerr << options.output << "/report.html: could not be written; the numbers are there\n";
  return kExitFileTrouble;
}

}  // namespace cosserat_cable
