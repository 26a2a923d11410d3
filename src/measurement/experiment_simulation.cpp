#include "cosserat_cable/measurement/experiment_simulation.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "channel_probe.h"
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
// A step that does not converge is taken in parts of down to dt/2^kMaxHalvings.
constexpr int kMaxHalvings = 5;
// Steps between two questions whether to go on.
constexpr int kStepsUnasked = 16;
constexpr const char* kStopped = "stopped";
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

/// Takes the step from `t` by `dt` alone, in ever smaller parts.
bool StepInParts(double t, double dt, Rig* rig) {
  const rod::Rod before = *rig->rod();
  for (int halvings = 1; halvings <= kMaxHalvings; ++halvings) {
    const int parts = 1 << halvings;
    bool ok = true;
    for (int k = 1; k <= parts && ok; ++k) {
      rig->MoveTo(t + dt * k / parts);
      ok = rig->rod()->Step(dt / parts, rig->clamp_a(), rig->clamp_b(), rig->load()).converged;
    }
    if (ok) return true;
    *rig->rod() = rod::Rod(before);
  }
  return false;
}

/// Rigs in the lanes of one kernel. Those that fail are left out from then on.
class Side {
 public:
  explicit Side(std::vector<Run> runs) : runs_(std::move(runs)), drives_(runs_.size()) {
    std::vector<rod::Rod*> rods;
    for (Run& run : runs_) rods.push_back(run.rig->rod());
    if (rods.size() > 1) batch_ = std::make_unique<rod::RodBatch>(rods);
  }

  /// The step `number`, or a part of it, of those that need it.
  void Step(int number, double t, double dt) {
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      drives_[k] = {};
      if (!Needs(runs_[k], number)) continue;
      Rig& rig = *runs_[k].rig;
      rig.MoveTo(t + dt);
      drives_[k] = {&rig.clamp_a(), &rig.clamp_b(), rig.load()};
    }
    if (batch_) {
      const std::vector<rod::SolveReport>& reports = batch_->Step(dt, drives_);
      for (std::size_t k = 0; k < runs_.size(); ++k)
        if (drives_[k].a && !reports[k].converged) Retry(t, dt, &runs_[k]);
    } else if (drives_[0].a) {
      const rod::SolveReport report =
          runs_[0].rig->rod()->Step(dt, *drives_[0].a, *drives_[0].b, drives_[0].load);
      if (!report.converged) Retry(t, dt, &runs_[0]);
    }
  }

  const std::vector<Run>& runs() const { return runs_; }
  void Fail(const std::string& why) {
    for (Run& run : runs_) {
      if (!run.result->ok) continue;
      run.result->ok = false;
      run.result->message = why;
    }
  }
  bool AnyNeeds(int step) const {
    return std::any_of(runs_.begin(), runs_.end(),
                       [&](const Run& run) { return Needs(run, step); });
  }
  /// Whether the run is to be sampled after a step; the start is step 0.
  static bool Needs(const Run& run, int step) { return run.result->ok && step < run.steps; }

 private:
  static void Retry(double t, double dt, Run* run) {
    if (StepInParts(t, dt, run->rig.get())) return;
    run->result->ok = false;
    run->result->message = "Newton's iteration does not converge at t = " + std::to_string(t) +
                           " s, with steps down to " +
                           std::to_string(dt * 1e6 / (1 << kMaxHalvings)) + " us";
  }

  std::vector<Run> runs_;
  std::unique_ptr<rod::RodBatch> batch_;
  std::vector<rod::RodDrive> drives_;
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

void SimulateMotion(const Experiment& experiment, const SimulationOptions& options,
                    std::vector<Run> all) {
  const double dt = options.dt;
  const int channels = static_cast<int>(experiment.channels.size());
  const double start = experiment.start_time();
  for (Run& run : all)
    run.steps =
        1 + std::max(1, static_cast<int>(std::ceil((run.times.back() - start) / dt - 1e-9)));
  Side side(std::move(all));
  const std::vector<Run>& runs = side.runs();
  std::vector<ChannelProbe> probes;
  std::vector<Trace> traces;
  for (const Run& run : runs) {
    probes.emplace_back(experiment.channels, run.sensors);
    traces.emplace_back(start, dt, run.steps, channels);
  }
  const auto sample = [&](int step) {
    for (std::size_t k = 0; k < traces.size(); ++k)
      if (Side::Needs(runs[k], step)) probes[k].Sample(*runs[k].rig, traces[k].at(step));
  };
  sample(0);
  double t = start, part = std::ldexp(dt, -kGrading);
  side.Step(1, t, part);
  for (t += part; part < dt; t += part, part *= 2) side.Step(1, t, part);
  for (int step = 1; side.AnyNeeds(step); ++step) {
    if (step > 1) side.Step(step, start + (step - 1) * dt, dt);
    if (step % kStepsUnasked == 0 && Stopped(options)) side.Fail(kStopped);
    sample(step);
  }
  for (std::size_t k = 0; k < traces.size(); ++k) {
    SimulatedRecord& result = *runs[k].result;
    if (!result.ok) continue;
    result.values.resize(static_cast<Eigen::Index>(runs[k].times.size()), channels);
    for (int c = 0; c < channels; ++c)
      result.values.col(c) = Shown(experiment, c, runs[k], &traces[k]);
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

/// Runs that can be stepped side by side: a clamp whose friction and springs are zero is rigid.
std::vector<std::vector<Run>> GroupsAlike(std::vector<Run> runs) {
  const auto ends = [](const Run& run) {
    const rod::RodModel& model = run.rig->rod()->model();
    return std::pair(model.a.clamped(), model.b.clamped());
  };
  std::vector<std::vector<Run>> groups;
  for (Run& run : runs) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const std::vector<Run>& one) {
      return ends(one.front()) == ends(run);
    });
    if (group == groups.end()) group = groups.insert(groups.end(), std::vector<Run>());
    group->push_back(std::move(run));
  }
  return groups;
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
      for (std::vector<Run>& alike : GroupsAlike(std::move(runs)))
        SimulateMotion(experiment, options, std::move(alike));
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
