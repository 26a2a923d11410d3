// One implicit step of generalised-alpha on the configuration space R^3 x SO(3) per node.
#pragma once

#include "chain_laws.h"
#include "chain_solver.h"
#include "cosserat_cable/rod/rod.h"
#include "end_part.h"
#include "load_power.h"

namespace cosserat_cable::rod {

/// What a step needs to know of one rod, and says of it.
struct StepOfRod {
  bool active = false;  ///< others are left out
  double length = 1;    ///< [m]
  const Load* load = nullptr;
  double time = 0;                 ///< at the step's end [s]
  const EndParts* ends = nullptr;  ///< of every rod in the chain
  LawsOfRod laws;
  SolveReport report;    ///< out
  LoadPower load_power;  ///< out: of `load` at the step's end
};

/// Finds the iterate in which all forces balance, for each rod of the chain. Expects the first
/// iterate and the held ends, law and offsets in the chain; leaves the iterate there, and what
/// loads add to it. A rod's result does not depend on the others. `rods`: by lane; of one in
/// halves, that one.
template <class T>
void SolveStep(const StepCoefficients& c, StepChain<T>* chain, StepOfRod* rods);

}  // namespace cosserat_cable::rod
