// The unknowns of a step and what it needs to find them: of one rod, or of four side by side.
#pragma once

#include <vector>

#include "block_tridiagonal.h"
#include "element_chain.h"

namespace cosserat_cable::rod {

/// Time derivatives of a node's velocity [m/s^2] and of its angular velocity in the section's frame
/// [rad/s^2].
template <class T>
struct NodeRates {
  Vec3<T> v, omega;
};

template <class T>
struct StepWorkspace {
  explicit StepWorkspace(int elements)
      : count(elements + 1),
        mass(count),
        inertia(count),
        node(count),
        rate(count),
        algorithm(count),
        trial(count),
        trial_rate(count),
        trial_algorithm(count),
        increment(count),
        rhs(count),
        chain(elements),
        system(count) {}

  int count;                     // of nodes
  std::vector<T> mass;           // lumped at the nodes [kg]
  std::vector<Vec3<T>> inertia;  // about the section's axes [kg m^2]
  Vec3<T> gravity;               // [m/s^2]
  ElementLaw<T> law;             // of the step or of statics, whichever was prepared last

  // The last accepted instant.
  std::vector<Node<T>> node;
  std::vector<NodeRates<T>> rate;       // true accelerations
  std::vector<NodeRates<T>> algorithm;  // generalised-alpha's own

  // The iterate.
  std::vector<Node<T>> trial;
  std::vector<NodeRates<T>> trial_rate, trial_algorithm;
  std::vector<Vec6<T>> increment;  // of the step: displacement, rotation vector
  std::vector<Vec6<T>> rhs;        // minus the residual, then the correction
  ElementChain<T> chain;
  BlockTridiagonal<T> system;
};

}  // namespace cosserat_cable::rod
