#include "time_step.h"

#include <algorithm>
#include <cmath>

#include "lane_view.h"

namespace cosserat_cable::rod {
namespace {

constexpr int kMaxIterations = 12;
// Newton stops where the error still left, last correction times contraction, is below this
// fraction of the length (and rad): 2e-9 m for a 200 mm cable.
constexpr double kTolerance = 1e-8;
// A correction this small is converged whatever the contraction.
constexpr double kRoundOff = 1e-12;
// The factors of the first iteration serve the second; whoever needs a third gets fresh ones. A
// fixed rule, so that no rod sees what its neighbours in the lanes need.
constexpr int kRefactorFrom = 3;

/// Takes the corrections of one lane back.
template <class T>
void ClearLane(int first, int last, int lane, std::vector<Vec6<T>>* rhs) {
  for (int i = first; i <= last; ++i)
    for (int k = 0; k < 6; ++k) SetLane(&(*rhs)[i][k], lane, 0.0);
}

}  // namespace

template <class T>
void SolveStep(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w,
               LaneTask* tasks) {
  constexpr int kLanes = kLaneCount<T>;
  bool running[kLanes];
  double previous[kLanes] = {};
  for (int l = 0; l < kLanes; ++l) {
    running[l] = tasks[l].active;
    tasks[l].report = SolveReport();
  }
  const auto any_running = [&] {
    return std::any_of(running, running + kLanes, [](bool r) { return r; });
  };
  const auto for_each_running = [&](auto act) {
    for (int l = 0; l < kLanes; ++l)
      if (running[l]) act(l, tasks[l]);
  };
  const auto balance = [&] {
    UpdateNodes(c, first, last, w);
    for (int l = 0; l < kLanes; ++l) ImposeEndRates(tasks[l].ends, l, w);
    EvaluateForces(w);
    SubtractInertia(w);
  };

  // Constant velocity: a predictor with the acceleration blows up after a velocity jump.
  Predict(c, first, last, w);
  for_each_running([&](int l, const LaneTask& task) { ImposeEnds(task.ends, l, w); });
  for (int iteration = 1; iteration <= kMaxIterations && any_running(); ++iteration) {
    balance();
    const bool fresh = iteration == 1 || iteration >= kRefactorFrom;
    if (fresh) AssembleTangent(c.velocity_by_increment, w);
    for_each_running([&](int l, const LaneTask& task) {
      if (task.load) AddLoad(*task.load, l, fresh, c.velocity_by_increment, w);
    });
    if (fresh) AddInertia(c, first, last, w);
    for_each_running([&](int l, const LaneTask& task) {
      ConstrainEnds(task.ends, l, fresh, c.velocity_by_increment, w);
    });
    T pivot(1.0);
    if (fresh) Factorise(first, last, w, &pivot);
    Solve(w);
    const CorrectionSize<T> size = MeasureCorrection(first, last, *w);
    for (int l = 0; l < kLanes; ++l) {
      if (!running[l]) {
        ClearLane(first, last, l, &w->rhs);
        continue;
      }
      SolveReport& report = tasks[l].report;
      report.iterations = iteration;
      report.correction =
          std::max(GetLane(size.translation, l) / tasks[l].length, GetLane(size.rotation, l));
      if (!std::isfinite(GetLane(size.sum, l)) || !(GetLane(pivot, l) > 0)) {
        running[l] = false;
        ClearLane(first, last, l, &w->rhs);
        continue;
      }
      const double contraction = previous[l] > 0 ? report.correction / previous[l] : 1.0;
      report.converged =
          report.correction < kRoundOff || contraction * report.correction < kTolerance;
      running[l] = !report.converged;
      previous[l] = report.correction;
    }
    Correct(first, last, w);
    for (int l = 0; l < kLanes; ++l) ImposeEnds(tasks[l].ends, l, w);
  }

  // What the accepted iterate's forces are.
  balance();
  for (int l = 0; l < kLanes; ++l)
    if (tasks[l].report.converged && tasks[l].load)
      tasks[l].load_power = AddLoad(*tasks[l].load, l, false, c.velocity_by_increment, w);
}

template void SolveStep(const StepCoefficients&, int, int, StepWorkspace<double>*, LaneTask*);
template void SolveStep(const StepCoefficients&, int, int, StepWorkspace<Lanes>*, LaneTask*);

}  // namespace cosserat_cable::rod
