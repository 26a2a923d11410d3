// One implicit step of generalised-alpha on the configuration space R^3 x SO(3) per node.
#pragma once

#include "cosserat_cable/rod/rod.h"
#include "step_kernels.h"

namespace cosserat_cable::rod {

/// Finds the iterate in which all forces balance, for the rod in each lane. Expects `node`, `rate`,
/// `algorithm`, law and offsets set, and the held ends in `trial` and `trial_rate`; nodes
/// `first`..`last` are free. Lanes that are not `active` are left out. A lane's result does not
/// depend on the others.
template <class T>
void SolveStep(const StepCoefficients& c, int first, int last, const double* lengths,
               const Load* const* loads, const bool* active, StepWorkspace<T>* w,
               SolveReport* reports);

}  // namespace cosserat_cable::rod
