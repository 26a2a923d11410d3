// The sweeps over a chain of which a time step is made.
#pragma once

#include "step_chain.h"
#include "step_coefficients.h"

namespace cosserat_cable::rod {

/// State of a rod before a step, or after it.
struct RodState {
  Node<double>* node;
  NodeRates<double>*rate, *algorithm;  // true accelerations, generalised-alpha's own
};

/// Declares each kernel for eight rods, for four, and for one in halves: a function template could
/// not be compiled for several instruction sets.
#define COSSERAT_CABLE_DECLARE_CHAIN_KERNELS(T)                                                   \
  /** The first iterate: constant velocity. `rods`: by lane; of one in halves, the same twice. */ \
  void Predict(const StepCoefficients& c, const RodState* rods, StepChain<T>* w);                 \
  /** Forces of the iterate; a new tangent and its factors where `fresh`, else the last ones';    \
      forward substitution. Lowers `smallest` to the smallest pivot: positive exactly where the   \
      tangent is positive definite. */                                                            \
  void EliminateForward(const StepCoefficients& c, bool fresh, StepChain<T>* w, T* smallest);     \
  /** Backward substitution; corrects the iterate in the lanes where `keep` is 1, not where it is \
      0. */                                                                                       \
  void CorrectBackward(const StepCoefficients& c, const T& keep, StepChain<T>* w,                 \
                       ChainCorrection<T>* size);                                                 \
  /** Strains of the iterate and what its ends lack to balance. */                                \
  void EvaluateAccepted(StepChain<T>* w);                                                         \
  /** The iterate becomes the state of the rods that are not null. */                             \
  void Accept(const StepCoefficients& c, const StepChain<T>& w, const RodState* const* rods);

COSSERAT_CABLE_DECLARE_CHAIN_KERNELS(WideLanes)
COSSERAT_CABLE_DECLARE_CHAIN_KERNELS(Lanes)
COSSERAT_CABLE_DECLARE_CHAIN_KERNELS(LanePair)
#undef COSSERAT_CABLE_DECLARE_CHAIN_KERNELS

}  // namespace cosserat_cable::rod
