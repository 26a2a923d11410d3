// The loops over nodes and elements of statics and of a time step, for one rod or for four.
#pragma once

#include "step_workspace.h"

namespace cosserat_cable::rod {

/// Generalised-alpha as linear functions of the increment over a step of `dt` [s].
struct StepCoefficients {
  explicit StepCoefficients(double dt);

  double dt;
  double velocity_by_increment;                   ///< d v_1/d(increment) [1/s]
  double algorithm_by_increment;                  ///< d a_1/d(increment) [1/s^2]
  double rate_by_increment;                       ///< d vdot_1/d(increment) [1/s^2]
  double old_position;                            ///< dt^2 (1/2 - beta), of a_0 in the increment
  double old_velocity, new_velocity;              ///< dt (1 - gamma), dt gamma
  double new_algorithm, old_algorithm, old_rate;  ///< vdot_1 from a_1, a_0, vdot_0
};

/// Largest entries of a correction, in m and rad, and a sum that is finite only if all are.
template <class T>
struct CorrectionSize {
  T translation, rotation, sum;
};

/// Declares each kernel for one rod and for four: a function template could not be compiled for
/// several instruction sets.
#define COSSERAT_CABLE_DECLARE_KERNELS(T)                                                       \
  /** Gravity and the internal forces of the iterate into `rhs`. */                             \
  void EvaluateForces(StepWorkspace<T>* w);                                                     \
  /** Elements' tangent with moduli C + rate_factor V into `system`; rate_factor in 1/s. */     \
  void AssembleTangent(double rate_factor, StepWorkspace<T>* w);                                \
  /** First increment of nodes `first`..`last`: constant velocity. */                           \
  void Predict(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w);            \
  /** The iterate that belongs to the increments. */                                            \
  void UpdateNodes(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w);        \
  /** Inertia forces and gyroscopic moments, all nodes. */                                      \
  void SubtractInertia(StepWorkspace<T>* w);                                                    \
  void AddInertia(const StepCoefficients& c, int first, int last, StepWorkspace<T>* w);         \
  /** Smallest pivot, see BlockTridiagonal; not by value: how lanes are returned depends on the \
      instruction set. */                                                                       \
  void Factorise(int first, int last, StepWorkspace<T>* w, T* smallest);                        \
  void Solve(StepWorkspace<T>* w);                                                              \
  CorrectionSize<T> MeasureCorrection(int first, int last, const StepWorkspace<T>& w);          \
  /** Adds the correction in `rhs` to the increments. */                                        \
  void Correct(int first, int last, StepWorkspace<T>* w);

COSSERAT_CABLE_DECLARE_KERNELS(double)
COSSERAT_CABLE_DECLARE_KERNELS(Lanes)
#undef COSSERAT_CABLE_DECLARE_KERNELS

}  // namespace cosserat_cable::rod
