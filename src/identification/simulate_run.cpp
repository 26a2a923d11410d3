#include "cosserat_cable/identification/simulate_run.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cosserat_cable/cable/section_file.h"
#include "cosserat_cable/console/interrupt.h"
#include "cosserat_cable/console/output_file.h"
#include "cosserat_cable/console/planned_outputs.h"
#include "cosserat_cable/console/progress.h"
#include "cosserat_cable/fit/start_estimate.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/experiment_simulation.h"
#include "cosserat_cable/measurement/record_csv.h"

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kFewestElements = 8;                           // of the finer of two runs
constexpr double kSmallestStep = 1e-6, kLargestStep = 0.02;  // [s]
// Beyond, a user should know that the figures are not converged.
constexpr double kCoarse = 0.02;  // of a channel's range

struct Job {
  const Experiment* experiment;
  Specimen specimen;
  SimulationOptions options;
  RefinedRecord result;
  bool done = false;
};

double SimulatedTime(const Experiment& experiment) {
  return experiment.quasi_static() ? 0.0 : experiment.record.t.back() - experiment.start_time();
}

std::vector<std::string> ColumnsOf(const Experiment& experiment) {
  std::vector<std::string> columns;
  for (const Channel& channel : experiment.channels) columns.push_back(channel.column);
  return columns;
}

void CheckOptions(const SimulateRunOptions& options, Problems* problems) {
  if (!(options.dt >= kSmallestStep && options.dt <= kLargestStep))
    problems->Add("", 0, "dt",
                  "got " + FormatNumber(options.dt) + ", expected a step in [1e-6, " + "0.02] [s]");
  if (options.elements != 0 &&
      (options.elements < kFewestElements || options.elements % 2 != 0 || options.elements > 1000))
    problems->Add(
        "", 0, "elements",
        "got " + std::to_string(options.elements) + ", expected an even number in [8, 1000]");
}

void Simulate(std::vector<Job>* jobs, bool plain) {
  Progress progress(static_cast<double>(jobs->size()), "experiments");
  std::mutex mutex;
  double count = 0;
  tbb::parallel_for(std::size_t{0}, jobs->size(), [&](std::size_t k) {
    if (Interrupted()) return;
    Job& job = (*jobs)[k];
    if (plain)
      job.result.record = SimulateExperiment(*job.experiment, {job.specimen}, job.options).front();
    else
      job.result = SimulateRefined(*job.experiment, job.specimen, job.options);
    job.done = true;
    const std::lock_guard<std::mutex> lock(mutex);
    progress.Update(++count, job.experiment->name);
  });
}

/// Rms of simulated less measured, by channel; without the mean where the channel's offset is
/// unknown.
nlohmann::json RmsOf(const Job& job) {
  nlohmann::json rms;
  Eigen::MatrixXd difference = job.result.record.values - job.experiment->record.values;
  for (Eigen::Index c = 0; c < difference.cols(); ++c)
    if (job.experiment->channels[static_cast<std::size_t>(c)].unknown_offset)
      difference.col(c).array() -= difference.col(c).mean();
  for (Eigen::Index c = 0; c < difference.cols(); ++c)
    rms[job.experiment->channels[static_cast<std::size_t>(c)].column] =
        std::sqrt(difference.col(c).squaredNorm() / static_cast<double>(difference.rows()));
  return rms;
}

void CheckOutputs(const SimulateRunOptions& options, const MeasurementSet& set,
                  Problems* problems) {
  PlannedOutputs outputs;
  for (const std::string& file : FilesOf(set)) outputs.Reads(file);
  outputs.Reads(options.cable);
  std::vector<std::string> files = {"simulated_cable.yaml"};
  for (const Experiment& experiment : set.experiments) files.push_back(experiment.name + ".csv");
  outputs.WritesFolder(options.output, "output", files);
  outputs.WritesFile(options.json, "json");
  outputs.Check(problems);
}

}  // namespace

ExitCode RunSimulate(const SimulateRunOptions& options) {
  const Clock::time_point begin = Clock::now();
  Problems problems;
  CheckOptions(options, &problems);
  const MeasurementSet set = LoadMeasurementSet(options.set, &problems);
  CheckOutputs(options, set, &problems);
  CableKeys file;
  if (!options.cable.empty()) file = LoadSpecimenFile(options.cable, &problems);
  std::vector<Job> jobs;
  if (problems.empty())
    for (const Experiment& experiment : set.experiments) {
      CableKeys keys = options.cable.empty() ? SpecimenKeys(set, experiment)
                                             : SpecimenKeys(set, experiment, file);
      if (experiment.quasi_static()) keys = WithoutUnknownDamping(keys);
      const bool swinging = experiment.start.kind == StartCondition::Kind::kUnknown;
      Job job{&experiment,
              swinging ? EstimateStart(experiment, keys, &problems)
                       : MakeSpecimen(keys, experiment, &problems),
              {},
              {},
              false};
      if (swinging)
        std::cerr << experiment.name << ": its start is estimated from the record's beginning\n";
      job.options.dt = options.dt;
      job.options.elements = options.elements ? options.elements : job.specimen.cable.elements;
      job.options.elements += job.options.elements % 2;
      job.options.elements = std::max(job.options.elements, kFewestElements);
      jobs.push_back(std::move(job));
    }
  if (!problems.empty()) {
    problems.SortByLine();
    std::cerr << problems.ToString();
    return kExitBadInput;
  }

  CatchInterrupts();
  Simulate(&jobs, options.plain);
  nlohmann::json summary = {{"format", 1}, {"set", options.set}, {"dt", options.dt}};
  double simulated = 0;
  ExitCode code = kExitDone;
  try {
    fs::create_directories(options.output);
    const auto path = [&](const std::string& name) {
      return (fs::path(options.output) / name).string();
    };
    std::printf("%-24s %8s %9s %14s%s\n", "experiment", "time [s]", "elements", "discretisation",
                options.rms ? "  rms against the record" : "");
    for (const Job& job : jobs) {
      const Experiment& experiment = *job.experiment;
      nlohmann::json entry = {{"elements", job.options.elements}};
      if (!job.done || !job.result.record.ok) {
        const std::string why = job.done ? job.result.record.message : "interrupted";
        std::cerr << experiment.name << ": " << why << "\n";
        entry["failure"] = why;
        code = job.done ? kExitFailed : kExitInterrupted;
        summary["experiments"][experiment.name] = entry;
        continue;
      }
      WriteWhole(path(experiment.name + ".csv"),
                 RecordCsv(experiment.record, ColumnsOf(experiment), job.result.record.values));
      simulated += SimulatedTime(experiment);
      entry["discretisation"] = job.result.discretisation;
      entry["extrapolated"] = job.result.extrapolated;
      std::string rms_text;
      if (options.rms) {
        entry["rms"] = RmsOf(job);
        for (const auto& [column, rms] : entry["rms"].items())
          rms_text += "  " + column + " " + FormatRounded(rms.get<double>(), 4);
      }
      std::printf("%-24s %8.3f %9d %14s%s\n", experiment.name.c_str(), SimulatedTime(experiment),
                  job.options.elements,
                  options.plain ? "-" : FormatRounded(job.result.discretisation, 2).c_str(),
                  rms_text.c_str());
      if (!options.plain && !job.result.extrapolated)
        std::cerr << "warning: " << experiment.name
                  << ": runs with different steps are too far apart to be extrapolated: take "
                     "smaller steps (--dt) or more elements (--elements)\n";
      else if (job.result.discretisation > kCoarse)
        std::cerr << "warning: " << experiment.name << ": the steps' error, corrected here, is "
                  << FormatRounded(100 * job.result.discretisation, 2)
                  << " % of a channel's range\n";
      summary["experiments"][experiment.name] = entry;
    }
    const double wall = std::chrono::duration<double>(Clock::now() - begin).count();
    summary["simulated_time"] = simulated;
    summary["wall_time"] = wall;
    WriteWhole(path("simulated_cable.yaml"),
               WriteCableFile({{jobs.front().specimen.cable}, {CableMarks()}, true}));
    std::printf("simulated %.3f s in %.2f s: real-time factor %.1f\n", simulated, wall,
                simulated / wall);
    if (!options.json.empty()) WriteWhole(options.json, summary.dump(2) + "\n");
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return kExitFileTrouble;
  }
  return Interrupted() ? kExitInterrupted : code;
}

}  // namespace cosserat_cable
