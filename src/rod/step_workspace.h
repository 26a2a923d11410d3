// A rod's state, and the unknowns of its equilibrium with what it takes to find them.
#pragma once

#include <vector>

#include "block_tridiagonal.h"
#include "element_chain.h"
#include "step_chain.h"

namespace cosserat_cable::rod {

template <class T>
struct StepWorkspace {
  explicit StepWorkspace(int elements)
      : count(elements + 1),
        mass(count),
        inertia(count),
        node(count),
        rate(count),
        algorithm(count),
        mean(count),
        trial(count),
        trial_rate(count),
        rhs(count),
        chain(elements),
        system(count) {}

  int count;                     // of nodes
  std::vector<T> mass;           // lumped at the nodes [kg]
  std::vector<Vec3<T>> inertia;  // about the section's axes [kg m^2]
  Vec3<T> gravity;               // [m/s^2]
  ElementLaw<T> law;             // of the step or of statics, whichever was prepared last

  // The last accepted instant.
  double time = 0;  // [s]
  std::vector<Node<T>> node;
  std::vector<NodeRates<T>> rate;       // true accelerations
  std::vector<NodeRates<T>> algorithm;  // generalised-alpha's own
  std::vector<NodeRates<T>> mean;       // of the latter, as in ChainState
  Persistence<T> persistence;

  // The iterate; of a time step only the ends that are held.
  std::vector<Node<T>> trial;
  std::vector<NodeRates<T>> trial_rate;
  std::vector<Vec6<T>> rhs;  // minus the residual, then the correction
  ElementChain<T> chain;
  BlockTridiagonal<T> system;
};

}  // namespace cosserat_cable::rod
