// One implicit step of generalised-alpha on the configuration space R^3 x SO(3) per node.
#pragma once

#include "cosserat_cable/rod/rod.h"
#include "lane_ends.h"
#include "step_kernels.h"

namespace cosserat_cable::rod {

/// The rod in one lane during one step.
struct LaneTask {
  bool active = false;  ///< otherwise it is left out
  double length = 0;    ///< [m]
  const Load* load = nullptr;
  LaneEnds ends;
  SolveReport report;     ///< out
  double load_power = 0;  ///< out: of `load` at the step's end [W]
};

/// Finds the iterate in which all forces balance, for the rod in each lane. Expects `node`, `rate`,
/// `algorithm`, law and offsets set, and clamped ends in `trial` and `trial_rate`; nodes
/// `first`..`last` are unknown. A lane's result does not depend on the others.
template <class T>
void SolveStep(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w,
               LaneTask* tasks);

}  // namespace cosserat_cable::rod
