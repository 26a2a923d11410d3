// The loops over nodes and elements of statics.
#pragma once

#include "step_workspace.h"

namespace cosserat_cable::rod {

/// Largest entries of a correction, in m and rad, and a sum that is finite only if all are.
template <class T>
struct CorrectionSize {
  T translation, rotation, sum;
};

/// Gravity and the internal forces of the iterate into `rhs`.
void EvaluateForces(StepWorkspace<double>* w);
/// Elements' tangent with moduli C + rate_factor V into `system`; rate_factor in 1/s.
void AssembleTangent(double rate_factor, StepWorkspace<double>* w);
/// Of nodes `first`..`last`; smallest pivot: see BlockTridiagonal.
void Factorise(int first, int last, StepWorkspace<double>* w, double* smallest);
void Solve(StepWorkspace<double>* w);
CorrectionSize<double> MeasureCorrection(int first, int last, const StepWorkspace<double>& w);

}  // namespace cosserat_cable::rod
