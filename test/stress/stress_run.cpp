#include "stress/stress_run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <thread>

#include "cosserat_cable/cable/cable_fleet.h"
#include "cosserat_cable/cable/resolution.h"
#include "stress/random_cable.h"

namespace cosserat_cable::stress {
namespace {

constexpr double kDt = 1e-3;  // as of cable_replay [s]
const Eigen::Vector3d kGravity(0, 0, -9.81);
// All numbers that a run publishes are looked at after every so many steps, and where it ends.
constexpr int kLookEvery = 10;
// A step that is halved five times is made of 6 attempts that fail and 32 that do not, of 24
// iterations each, as time_step.cpp bounds them: none can take more.
constexpr int kMostIterations = (6 + 32) * 24;
constexpr double kSlowIterations = 30;  // a step in the mean; a smooth motion takes 3

bool IsFinite(const CableReport& r) {
  for (const Eigen::Vector3d* v :
       {&r.apex, &r.apex_velocity, &r.force_a, &r.moment_a, &r.force_b, &r.moment_b})
    if (!v->allFinite()) return false;
  return std::isfinite(r.curvature_max) && std::isfinite(r.tension_max) &&
         std::isfinite(r.energy.Residual());
}

bool IsFinite(const CableSimulation& cable, const CableReport& report) {
  const auto finite = [](const Pose& X) { return X.p.allFinite() && X.q.coeffs().allFinite(); };
  return std::all_of(cable.nodes().begin(), cable.nodes().end(), finite) && IsFinite(report);
}

/// A cable on its way.
struct Going {
  Going(std::uint32_t seed, std::uint32_t index)
      : cable(MakeRandomCable(seed, index)), simulation(cable.model, {}, kGravity) {
    run.index = index;
    run.EI = std::min(cable.model.EI1, cable.model.EI2);
  }

  void Stop(End end, const std::string& message, double time) {
    char at[40];
    std::snprintf(at, sizeof at, "at %.3f s: ", time);
    run.end = end;
    run.message = at + message;
    going = false;
  }
  void Look(double time) {
    const CableReport report = simulation.ReportForces();
    if (!IsFinite(simulation, report)) {
      Stop(End::kNotFinite, "its state or report is not finite", time);
      return;
    }
    if (!TooLongElements(cable.model, report.tension_max, report.curvature_max).empty())
      run.resolved = false;
  }
  void Fail(const std::string& message, double time) {
    Stop(message.empty() ? End::kUnnamedFailure : End::kNamedFailure, message, time);
  }
  void Settle() {
    const StepOutcome outcome = simulation.Settle(cable.motion.At(0), Unstable::kFalls);
    if (outcome.ok)
      Look(0);
    else
      Fail(outcome.message, 0);
  }
  void Take(const StepOutcome& outcome, int step) {
    const double time = step * kDt;
    run.iterations += outcome.iterations;
    if (outcome.substeps > 1) ++run.retried;
    if (outcome.ok) ++run.steps;
    if (!outcome.ok || step % kLookEvery == 0) Look(time);
    if (!going) return;
    if (!outcome.ok)
      Fail(outcome.message, time);
    else if (outcome.iterations > kMostIterations)
      Stop(End::kPastItsBound, std::to_string(outcome.iterations) + " iterations", time);
  }

  RandomCable cable;
  CableSimulation simulation;
  Run run;
  bool going = true;
};

void RunGroup(std::uint32_t seed, std::uint32_t first, std::uint32_t count, Run* runs) {
  std::vector<Going> cables;
  cables.reserve(count);
  for (std::uint32_t i = first; i < first + count; ++i) cables.emplace_back(seed, i);
  std::vector<CableSimulation*> simulations;
  for (Going& cable : cables) {
    cable.Settle();
    simulations.push_back(&cable.simulation);
  }
  CableFleet fleet(simulations);
  const int steps = static_cast<int>(std::lround(kDuration / kDt));
  std::vector<Surroundings> there(count);
  std::vector<const Surroundings*> then(count);
  for (int step = 1; step <= steps; ++step) {
    for (std::uint32_t k = 0; k < count; ++k) {
      if (cables[k].going) there[k] = cables[k].cable.motion.At(step * kDt);
      then[k] = cables[k].going ? &there[k] : nullptr;
    }
    const std::vector<StepOutcome> outcomes = fleet.Step(kDt, then);
    for (std::uint32_t k = 0; k < count; ++k)
      if (then[k]) cables[k].Take(outcomes[k], step);
  }
  for (std::uint32_t k = 0; k < count; ++k) {
    if (cables[k].going) cables[k].run.end = End::kConverged;
    runs[k] = std::move(cables[k].run);
  }
}

}  // namespace

bool Run::slow() const { return iterations > kSlowIterations * steps && steps > 0; }

std::vector<Run> RunCables(std::uint32_t seed, std::uint32_t first, std::uint32_t count,
                           int threads, const std::function<bool(std::uint32_t)>& go_on) {
  std::vector<Run> runs(count);
  std::atomic<std::uint32_t> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;
  std::uint32_t finished = 0;
  const auto work = [&] {
    while (!stop) {
      const std::uint32_t begin = next.fetch_add(kAlike);
      if (begin >= count) return;
      const std::uint32_t of_group = std::min(kAlike, count - begin);
      RunGroup(seed, first + begin, of_group, &runs[begin]);
      const std::lock_guard<std::mutex> lock(mutex);
      finished += of_group;
      if (!go_on(finished)) stop = true;
    }
  };
  std::vector<std::thread> workers;
  for (int t = 1; t < threads; ++t) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();
  return runs;
}

}  // namespace cosserat_cable::stress
