// The sweeps over a chain that solve the linear system of one iteration.
#pragma once

#include "step_chain.h"
#include "step_coefficients.h"

namespace cosserat_cable::rod {

/// Declares both for eight rods, for four, and for one in halves, and for the numbers F in which
/// the system is solved: a function template could not be compiled for several instruction sets.
#define COSSERAT_CABLE_DECLARE_CHAIN_SOLVER(T, F)                                                 \
  /** Forces of the iterate; a new tangent and its factors where `fresh`, else the last ones';    \
      forward substitution. Lowers `smallest` to the smallest pivot: positive exactly where the   \
      tangent is positive definite, but for F's rounding. */                                      \
  void EliminateForward(const StepCoefficients& c, bool fresh, StepChain<T>* w,                   \
                        Elimination<F>* solver, F* smallest);                                     \
  /** Backward substitution; corrects the iterate in the lanes where `keep` is 1, not where it is \
      0. */                                                                                       \
  void CorrectBackward(const StepCoefficients& c, const T& keep, const Elimination<F>& solver,    \
                       StepChain<T>* w, ChainCorrection<T>* size);

COSSERAT_CABLE_DECLARE_CHAIN_SOLVER(WideLanes, Quick<WideLanes>)
COSSERAT_CABLE_DECLARE_CHAIN_SOLVER(WideLanes, WideLanes)
COSSERAT_CABLE_DECLARE_CHAIN_SOLVER(Lanes, Quick<Lanes>)
COSSERAT_CABLE_DECLARE_CHAIN_SOLVER(Lanes, Lanes)
COSSERAT_CABLE_DECLARE_CHAIN_SOLVER(LanePair, LanePair)
#undef COSSERAT_CABLE_DECLARE_CHAIN_SOLVER

}  // namespace cosserat_cable::rod
