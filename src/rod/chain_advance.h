// The sweeps over a chain that begin a step and end it.
#pragma once

#include "step_chain.h"
#include "step_coefficients.h"

namespace cosserat_cable::rod {

/// Declares each for eight rods, for four, and for one in halves: a function template could not be
/// compiled for several instruction sets.
#define COSSERAT_CABLE_DECLARE_CHAIN_ADVANCE(T)                                                   \
  /** The first iterate, with constant velocity, and the offsets of the step's law, from the      \
      state. */                                                                                   \
  void Predict(const StepCoefficients& c, StepChain<T>* w);                                       \
  /** The iterate becomes the state in the lanes where `taken` is 1, not where it is 0; sets what \
      the ends lack to balance and what was dissipated. */                                        \
  void Accept(const StepCoefficients& c, const T& taken, StepChain<T>* w);                        \
  /** Strains of the state. */                                                                    \
  void EvaluateStrains(StepChain<T>* w);

COSSERAT_CABLE_DECLARE_CHAIN_ADVANCE(WideLanes)
COSSERAT_CABLE_DECLARE_CHAIN_ADVANCE(Lanes)
COSSERAT_CABLE_DECLARE_CHAIN_ADVANCE(LanePair)
#undef COSSERAT_CABLE_DECLARE_CHAIN_ADVANCE

}  // namespace cosserat_cable::rod
