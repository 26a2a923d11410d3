// The internal variables of shear (shear_series.h) of all rods of a chain, an element of each at a
// time.
#pragma once

#include "shear_series.h"
#include "step_chain.h"

namespace cosserat_cable::rod {

/// A step's law of each lane's rod, and where its state is.
template <class T>
struct ShearLanes {
  ShearStep<T> axis[2];  // along a1 and a2
  Vec3<T> unbend;        // what an unstressed curvature adds to the moment [N m]
  Vec3<T> gamma0;        // unstressed strain [1], as the rod itself sees it
  T per_length;          // by the elements' lengths [1/m]; negative where a half runs backwards
  T forwards;            // 1, or -1 there
  // By element; of no rod that does not take its step.
  ShearHistory* history[kLaneCount<T>] = {};
  ElementOffset<double>* offsets[kLaneCount<T>] = {};
  T dissipation = 0.0;  // found by CommitShear, per length of an element [W/m]
};

/// Declares each for eight rods, for four, and for one in halves, as the chain's other sweeps.
#define COSSERAT_CABLE_DECLARE_SHEAR(T)                                             \
  /** Offsets of the step's law from the histories, into the chain and the rods. */ \
  void OffsetShear(const ShearLanes<T>& shear, StepChain<T>* chain);                \
  /** The histories after the step, from the strains of the accepted iterate. */    \
  void CommitShear(const StepChain<T>& chain, ShearLanes<T>* shear);
COSSERAT_CABLE_DECLARE_SHEAR(WideLanes)
COSSERAT_CABLE_DECLARE_SHEAR(Lanes)
COSSERAT_CABLE_DECLARE_SHEAR(LanePair)
#undef COSSERAT_CABLE_DECLARE_SHEAR

}  // namespace cosserat_cable::rod
