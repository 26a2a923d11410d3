#include "peer_search.h"

#include <algorithm>
#include <cmath>

#include "mujoco_chain.h"
#include "rod_arch.h"

namespace cosserat_cable::bench {
namespace {

Trial Judged(Trial trial, const Target& target) {
  if (trial.run.done()) {
    trial.apex_error = LargestError(trial.run.apex, target.apex);
    trial.sway_error = LargestError(trial.run.sway, target.sway);
  }
  return trial;
}

Trial MujocoTrial(const SweptArch& arch, const MujocoSetting& setting, double end, double budget) {
  return {"mujoco",       setting.elements,
          setting.dt,     setting.integrator,
          setting.solver, RunSweep(MujocoChain(arch, setting), setting.dt, end, budget)};
}

}  // namespace

std::vector<Trial> TryRod(const SweptArch& arch, const Target& target, const Grid& grid,
                          const Reporter& report) {
  std::vector<Trial> trials;
  for (const int elements : grid.elements)
    for (const double dt : grid.steps) {
      const SweepRun run = RunSweep(RodArch(arch, {elements, dt}), dt, grid.end);
      trials.push_back(Judged({"rod", elements, dt, "", "", run}, target));
      report(trials.back());
    }
  return trials;
}

std::vector<Trial> TryMujoco(const SweptArch& arch, const Target& target, const MujocoGrid& grid,
                             double tolerance, const Reporter& report) {
  // Where half of the step moves the error by less than this, the rest is the elements'.
  constexpr double kSettled = 0.1;
  std::vector<Trial> trials;
  double budget = grid.budget;
  for (const std::string& integrator : grid.integrators)
    for (const std::string& solver : grid.solvers)
      for (const int elements : grid.elements) {
        double last = 0;
        for (const double dt : grid.steps) {
          const MujocoSetting setting{elements, dt, integrator, solver};
          trials.push_back(Judged(MujocoTrial(arch, setting, grid.end, budget), target));
          const Trial& trial = trials.back();
          report(trial);
          if (trial.run.outcome == "too slow") break;
          if (!trial.run.done() || tolerance <= 0) continue;
          if (trial.apex_error <= tolerance) {
            budget = std::min(budget, trial.run.seconds);
            break;
          }
          if (last > 0 && std::abs(trial.apex_error - last) < kSettled * last) break;
          last = trial.apex_error;
        }
      }
  return trials;
}

const Trial* Cheapest(const std::vector<Trial>& trials, double tolerance) {
  const auto within = [&](const Trial& t) { return t.run.done() && t.apex_error <= tolerance; };
  // Where a finer step is worse, errors of elements and steps cancel: luck is not accuracy.
  const auto by_luck = [&](const Trial& trial) {
    return std::any_of(trials.begin(), trials.end(), [&](const Trial& finer) {
      return finer.elements == trial.elements && finer.integrator == trial.integrator &&
             finer.solver == trial.solver && finer.dt < trial.dt && finer.run.done() &&
             !within(finer);
    });
  };
  const Trial* best = nullptr;
  for (const Trial& trial : trials)
    if (within(trial) && !by_luck(trial) && (!best || trial.run.seconds < best->run.seconds))
      best = &trial;
  return best;
}

const Trial* MostAccurate(const std::vector<Trial>& trials) {
  const Trial* best = nullptr;
  for (const Trial& trial : trials)
    if (trial.run.done() && (!best || trial.apex_error < best->apex_error)) best = &trial;
  return best;
}

SweepRun Repeat(const SweptArch& arch, const Trial& trial, double end) {
  if (trial.code == "rod")
    return RunSweep(RodArch(arch, {trial.elements, trial.dt}), trial.dt, end);
  return RunSweep(MujocoChain(arch, {trial.elements, trial.dt, trial.integrator, trial.solver}),
                  trial.dt, end);
}

}  // namespace cosserat_cable::bench
