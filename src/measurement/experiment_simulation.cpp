#include "cosserat_cable/measurement/experiment_simulation.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "channel_probe.h"
#include "cosserat_cable/cable/cable_fleet.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/rod_batch.h"
#include "low_pass.h"
#include "record_clock.h"
#include "rig.h"
#include "sensor.h"
#include "trace.h"

namespace cosserat_cable {
namespace {

// A release is a jump of the accelerations, which a step of full size would spread over its length.
// The first step is taken in parts that begin with dt/2^kGrading and double.
constexpr int kGrading = 10;
// Steps between two questions whether to go on.
constexpr int kStepsUnasked = 16;
constexpr const char* kStopped = "stopped";
// What is kept of each step is some hundred bytes; more would fill the memory.
constexpr double kMostSteps = 5e7;
// Two runs farther apart than this part of a channel's range say nothing about a third.
constexpr double kNearEnough = 0.1;

/// Samples that are asked for: those up to `until`.
int SamplesUntil(const std::vector<double>& t, double until) {
  return static_cast<int>(std::upper_bound(t.begin(), t.end(), until) - t.begin());
}

/// One of several rigs that are stepped together, from the record's times to what its sensors show.
struct Run {
  std::unique_ptr<Rig> rig;
  SimulatedRecord* result;
  std::vector<double> times;  ///< of the record's samples, on the motion's clock [s]
  std::vector<ChannelSensor> sensors;
  int steps = 0;  ///< that its samples need, and the start
};

bool Stopped(const SimulationOptions& options) { return options.stop && options.stop(); }

/// What the channel's sensor shows of its trace at the samples' times.
Eigen::VectorXd Shown(const Experiment& experiment, int channel, const Run& run, Trace* trace) {
  const Channel& of = experiment.channels[static_cast<std::size_t>(channel)];
  const ChannelSensor& sensor = run.sensors[static_cast<std::size_t>(channel)];
  if (ChannelProbe::Winds(of.quantity)) trace->Unwrap(channel);
  const int order = ChannelProbe::DerivativeOrder(of.quantity);
  const LowPass::Before before = experiment.start.kind == StartCondition::Kind::kUnknown
                                     ? LowPass::Before::kSwings
                                 : experiment.a.motion ? LowPass::Before::kGoesSteady
                                                       : LowPass::Before::kStands;
  std::optional<LowPass> filtered;
  for (std::size_t k = 0; k < sensor.low_passes.size(); ++k) {
    if (filtered)
      for (int step = 0; step < trace->steps(); ++step)
        trace->at(step)[channel] = filtered->steps()[static_cast<std::size_t>(step)];
    filtered.emplace(*trace, channel, sensor.low_passes[k], before);
  }
  Eigen::VectorXd shown(static_cast<Eigen::Index>(run.times.size()));
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    // Before the start, the rig stands in its start's shape.
    const double start = trace->start(), t = std::max(run.times[i], start);
    double& value = shown[static_cast<Eigen::Index>(i)];
    if (run.times[i] < start && order > 0)
      value = 0;
    else
      value = filtered ? filtered->Evaluate(t, order) : trace->Evaluate(channel, t, order);
    if (sensor.scale != 1) value *= sensor.scale;
  }
  return shown;
}

/// Whether the run is to be sampled after a step; the start is step 0.
bool Needs(const Run& run, int step) { return run.result->ok && step < run.steps; }

void Fail(const std::string& why, Run* run) {
  run->result->ok = false;
  run->result->message = why;
}

/// Runs that are a group of the fleet, from their start on. Those that fail are left out from then.
void SimulateGroup(const Experiment& experiment, const SimulationOptions& options,
                   const std::vector<Run*>& runs, std::size_t group, CableFleet* fleet) {
  const double start = experiment.start_time(), dt = options.dt;
  const int channels = static_cast<int>(experiment.channels.size());
  std::vector<ChannelProbe> probes;
  std::vector<Trace> traces;
  for (const Run* run : runs) {
    probes.emplace_back(experiment.channels, run->sensors);
    traces.emplace_back(start, dt, run->steps, channels);
  }
  const auto sample = [&](int step) {
    for (std::size_t k = 0; k < runs.size(); ++k)
      if (Needs(*runs[k], step)) probes[k].Sample(*runs[k]->rig, traces[k].at(step));
  };
  std::vector<const Surroundings*> then(runs.size());
  std::vector<StepOutcome> outcomes(runs.size());
  // The step of this number, or a part of it, of those that need it.
  const auto advance = [&](int step, double t, double h) {
    for (std::size_t k = 0; k < runs.size(); ++k)
      then[k] = Needs(*runs[k], step) ? &runs[k]->rig->At(t + h) : nullptr;
    fleet->StepGroup(group, h, then, &outcomes);
    for (std::size_t k = 0; k < runs.size(); ++k)
      if (then[k] && !outcomes[k].ok)
        Fail("at t = " + std::to_string(t) + " s: " + outcomes[k].message, runs[k]);
  };
  sample(0);
  double t = start, part = std::ldexp(dt, -kGrading);
  advance(1, t, part);
  for (t += part; part < dt; t += part, part *= 2) advance(1, t, part);
  const auto any_needs = [&](int step) {
    return std::any_of(runs.begin(), runs.end(), [&](const Run* run) { return Needs(*run, step); });
  };
  for (int step = 1; any_needs(step); ++step) {
    if (step > 1) advance(step, start + (step - 1) * dt, dt);
    if (step % kStepsUnasked == 0 && Stopped(options))
      for (Run* run : runs)
        if (run->result->ok) Fail(kStopped, run);
    sample(step);
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    SimulatedRecord& result = *runs[k]->result;
    if (!result.ok) continue;
    result.values.resize(static_cast<Eigen::Index>(runs[k]->times.size()), channels);
    for (int c = 0; c < channels; ++c)
      result.values.col(c) = Shown(experiment, c, *runs[k], &traces[k]);
  }
}

void SimulateMotion(const Experiment& experiment, const SimulationOptions& options,
                    std::vector<Run>* runs) {
  std::vector<CableSimulation*> cables;
  for (Run& run : *runs) {
    const double duration = run.times.back() - experiment.start_time();
    const double steps = std::ceil(duration / options.dt - 1e-9);
    if (!(steps <= kMostSteps))
      Fail("takes " + FormatRounded(steps) + " steps of " + FormatNumber(options.dt) +
               " s, at most " + FormatNumber(kMostSteps) +
               " fit: cut the record, or take larger ones",
           &run);
    run.steps = run.result->ok ? 1 + std::max(1, static_cast<int>(steps)) : 1;
    cables.push_back(run.rig->cable());
  }
  CableFleet fleet(cables, 1, LoneCable::kByItself);
  for (std::size_t group = 0; group < fleet.group_count(); ++group) {
    std::vector<Run*> members;
    for (const std::size_t k : fleet.members(group)) members.push_back(&(*runs)[k]);
    SimulateGroup(experiment, options, members, group, &fleet);
  }
}

void SimulateStatics(const Experiment& experiment, const SimulationOptions& options, Run* run) {
  SimulatedRecord& result = *run->result;
  const auto samples = static_cast<int>(run->times.size());
  result.values.resize(samples, static_cast<int>(experiment.channels.size()));
  ChannelProbe probe(experiment.channels, run->sensors);
  Eigen::VectorXd row(result.values.cols());
  for (int i = 0; i < samples && result.ok; ++i) {
    result.ok = run->rig->Equilibrate(
        static_cast<int>(experiment.record.t[static_cast<std::size_t>(i)]), &result.message);
    if (result.ok && Stopped(options)) {
      result.ok = false;
      result.message = kStopped;
    }
    if (!result.ok) break;
    probe.Sample(*run->rig, row);
    for (Eigen::Index c = 0; c < row.size(); ++c) {
      const auto channel = static_cast<std::size_t>(c);
      const double scale = run->sensors[channel].scale;
      const bool winds = ChannelProbe::Winds(experiment.channels[channel].quantity);
      if (i > 0 && winds) row[c] = Unwrapped(row[c], result.values(i - 1, c) / scale);
      if (scale != 1) row[c] *= scale;
    }
    result.values.row(i) = row.transpose();
  }
}

}  // namespace

std::vector<SimulatedRecord> SimulateExperiment(const Experiment& experiment,
                                                const std::vector<Specimen>& specimens,
                                                const SimulationOptions& options) {
  std::vector<SimulatedRecord> results(specimens.size());
  RigPaths paths(experiment);
  const int samples = SamplesUntil(experiment.record.t, options.until);
  const auto together = static_cast<std::size_t>(rod::RodBatch::PreferredRods());
  for (std::size_t first = 0; first < specimens.size(); first += together) {
    std::vector<Run> runs;
    for (std::size_t k = first; k < std::min(first + together, specimens.size()); ++k) {
      if (Stopped(options)) {
        results[k].ok = false;
        results[k].message = kStopped;
        continue;
      }
      const Faults& faults = specimens[k].faults;
      Run run;
      run.rig = std::make_unique<Rig>(experiment, specimens[k], options.elements, &paths);
      run.result = &results[k];
      run.times.assign(experiment.record.t.begin(), experiment.record.t.begin() + samples);
      if (!experiment.quasi_static()) run.times = MotionTimes(run.times, faults.clock);
      run.sensors = SensorsOf(experiment.channels, faults);
      results[k].ok = run.rig->Start(&results[k].message, options.rest.get());
      if (results[k].ok) runs.push_back(std::move(run));
    }
    if (runs.empty() || samples == 0) continue;
    if (experiment.quasi_static())
      for (Run& run : runs) SimulateStatics(experiment, options, &run);
    else
      SimulateMotion(experiment, options, &runs);
  }
  return results;
}

double RelativeDifference(const Experiment& experiment, double length,
                          const Eigen::MatrixXd& difference, const Eigen::MatrixXd& values) {
  // A channel that hardly moves beside others of its kind is not measured by itself.
  constexpr double kPartOfWidest = 0.1;
  const auto range = [&](Eigen::Index c) {
    return values.col(c).maxCoeff() - values.col(c).minCoeff();
  };
  double largest = 0;
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const Quantity quantity = experiment.channels[static_cast<std::size_t>(c)].quantity;
    double scale = range(c);
    for (Eigen::Index k = 0; k < values.cols(); ++k)
      if (experiment.channels[static_cast<std::size_t>(k)].quantity == quantity)
        scale = std::max(scale, kPartOfWidest * range(k));
    const double mean = difference.col(c).mean();
    const double static_scale =
        quantity == Quantity::kPosition ? length : values.col(c).cwiseAbs().maxCoeff();
    if (scale > 0)
      largest = std::max(largest, (difference.col(c).array() - mean).abs().maxCoeff() / scale);
    if (static_scale > 0) largest = std::max(largest, std::abs(mean) / static_scale);
  }
  return largest;
}

RefinedRecord SimulateRefined(const Experiment& experiment, const Specimen& specimen,
                              const SimulationOptions& options) {
  SimulationOptions coarse = options;
  coarse.dt = 2 * options.dt;
  coarse.elements = options.elements / 2;
  RefinedRecord refined;
  refined.record = SimulateExperiment(experiment, {specimen}, options).front();
  if (!refined.record.ok) return refined;
  const SimulatedRecord other = SimulateExperiment(experiment, {specimen}, coarse).front();
  if (!other.ok) {
    refined.discretisation = 1;
    return refined;
  }
  const Eigen::MatrixXd& fine = refined.record.values;
  const Eigen::MatrixXd correction = (fine - other.values) / 3;
  refined.discretisation = RelativeDifference(experiment, specimen.cable.length, correction, fine);
  refined.extrapolated = refined.discretisation < kNearEnough;
  if (refined.extrapolated) refined.record.values += correction;
  return refined;
}

std::shared_ptr<const std::vector<Pose>> FindRest(const Experiment& experiment,
                                                  const Specimen& specimen, int elements,
                                                  const std::vector<Pose>* near) {
  RigPaths paths(experiment);
  Rig rig(experiment, specimen, elements, &paths);
  std::string message;
  if (!rig.Start(&message, near)) return nullptr;
  return std::make_shared<const std::vector<Pose>>(rig.rest());
}

std::vector<SwingShape> FindSwingShapes(const Experiment& experiment, const Specimen& specimen,
                                        int elements, int count) {
  Specimen resting = specimen;
  resting.swing = Swing();
  RigPaths paths(experiment);
  Rig rig(experiment, resting, elements, &paths);
  std::string message;
  std::vector<SwingShape> shapes;
  if (!rig.Start(&message)) return shapes;
  const rod::Rod held = rig.WithSlidesHeld();
  for (rod::Mode& mode : rod::FindModes(held, count, rig.load())) {
    for (int i = 0; i <= elements; ++i)
      mode.rotation[static_cast<std::size_t>(i)] =
          held.pose(i).q.conjugate() * mode.rotation[static_cast<std::size_t>(i)];
    shapes.push_back({mode.w, mode.zeta, std::move(mode.displacement), std::move(mode.rotation)});
  }
  return shapes;
}

}  // namespace cosserat_cable
