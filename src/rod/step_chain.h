// The unknowns of a time step and what it needs to find them, in the order in which the solver runs
// over them: four or eight rods side by side, each from its first node to its last; or one rod from
// both ends to a node in its middle, so that its halves are side by side.
#pragma once

#include <algorithm>
#include <vector>

#include "block_tridiagonal.h"
#include "element_joint.h"
#include "node_elimination.h"
#include "shear_series.h"

namespace cosserat_cable::rod {

/// Time derivatives of a node's velocity [m/s^2] and of its angular velocity in the section's frame
/// [rad/s^2].
template <class T>
struct NodeRates {
  Vec3<T> v, omega;
};

/// Where the nodes and elements of the rods are in the chain.
///
/// Of one rod in two halves, the second runs backwards: an element seen from its other end has the
/// same law with strains, offsets and stresses of opposite sign. With an odd number of elements the
/// first half has a node before its first, which is nowhere and held.
struct ChainLayout {
  struct Place {
    int entry, lane;
  };

  static ChainLayout Side(int elements) { return {elements, false}; }
  static ChainLayout Halves(int elements) { return {elements, true}; }

  ChainLayout(int rod_elements, bool in_halves)
      : elements(rod_elements),
        halves(in_halves),
        padding(halves ? elements % 2 : 0),
        chain_elements(halves ? (elements + 1) / 2 : elements),
        middle(elements / 2) {}

  /// Of a node of the rod that is alone, or in `lane`.
  Place OfNode(int node, int lane) const {
    if (!halves) return {node, lane};
    return node <= middle ? Place{node + padding, 0} : Place{elements - node, 1};
  }
  /// Of the element after node `element`.
  Place OfElement(int element, int lane) const {
    if (!halves) return {element, lane};
    return element < middle ? Place{element + padding, 0} : Place{elements - 1 - element, 1};
  }
  /// The node, and -1 for the one that is nowhere.
  int NodeAt(int entry, int lane) const {
    return halves ? (lane == 0 ? entry - padding : elements - entry) : entry;
  }
  /// The element after an entry, towards the chain's end; -1 for the one before the first.
  int ElementAt(int entry, int lane) const {
    return halves ? (lane == 0 ? entry - padding : elements - 1 - entry) : entry;
  }

  int elements;
  bool halves;
  int padding, chain_elements, middle;
};

/// A node before a step.
template <class T>
struct ChainState {
  Node<T> at;
  NodeRates<T> rate, algorithm;  // true accelerations, generalised-alpha's own
  // The mean of the latter over the last step, whose increment was dt v + dt^2/2 mean. It is smooth
  // where what a stiff section leaves of a jolt turns the sign of `algorithm` from step to step.
  NodeRates<T> mean;
};

/// How much of the nodes' mean accelerations the next step is guessed to keep, in [0, 1]: as much
/// as would have been the best guess (least squares over the rod) for the step before. Next to all
/// of it in a smooth motion, nothing after a jolt.
template <class T>
struct Persistence {
  T v = 0.0, omega = 0.0;
};

template <class T>
struct ChainNode {
  Node<T> at;         // the iterate
  NodeRates<T> rate;  // its true accelerations

  Quat<T> q0;    // where it was before the step
  Vec3<T> turn;  // its rotation in the step [rad]
};

/// Shear's internal variables of an element, along a1 and a2, as the rod itself sees it.
template <class T>
struct ChainShear {
  ShearHistoryOf<T> x, y;
};

/// Each rod's law of shear over the step, and what else its elements have in common.
template <class T>
struct ChainShearLaw {
  ShearStep<T> x, y;  // along a1 and a2
  Vec3<T> gamma0;     // unstressed strain [1], as the rod itself sees it
  T per_length;       // by the elements' lengths [1/m]; negative where a half runs backwards
  T forwards;         // 1, or -1 there
};

template <class T>
struct NodeMass {
  T mass;           // lumped at the node [kg]
  Vec3<T> inertia;  // about the section's axes [kg m^2]
};

template <class T>
struct ChainStrain {
  Vec3<T> u, u_rate, theta, theta_rate;  // as in ElementState
};

/// Squares of a correction's norm over all nodes [m^2], [rad^2].
template <class T>
struct ChainCorrection {
  T translation, rotation;
};

/// What a sweep leaves of the chain's linear system, solved in numbers F.
template <class F>
struct Elimination {
  explicit Elimination(std::size_t nodes) : factors(nodes), rhs(nodes) {}

  std::vector<NodeFactor<F>> factors;
  std::vector<Vec6<F>> rhs;  // minus the residual, substituted forwards
};

/// In what the systems of a step in T are solved. Residuals are exact, so that factors in float
/// cost no accuracy, at most an iteration; they are half as many bytes, and of eight rods half as
/// many operations. Four rods take the same, so that no rod sees how many are stepped with it; a
/// single one in halves gains nothing by it.
template <class T>
struct QuickNumber {
  using Type = T;
};
template <>
struct QuickNumber<Lanes> {
  using Type = BasicLanes<4, float>;
};
template <>
struct QuickNumber<WideLanes> {
  using Type = BasicLanes<8, float>;
};
template <class T>
using Quick = typename QuickNumber<T>::Type;

template <class T>
struct StepChain {
  explicit StepChain(const ChainLayout& where)
      : layout(where),
        state(layout.chain_elements + 1),
        shear(layout.chain_elements),
        next_shear(shear.size()),
        tension(shear.size(), T(0.0)),
        next_tension(tension),
        stiffening(shear.size()),
        taut_laws(shear.size()),
        nodes(state.size()),
        masses(state.size()),
        shear_offsets(layout.chain_elements),
        branch_offsets(layout.chain_elements),
        strains(layout.chain_elements),
        quick(nodes.size()),
        exact(nodes.size()),
        load_rhs(nodes.size()),
        load_diagonal(nodes.size()),
        load_lower(nodes.size()) {
    if (layout.padding > 0) SetLane(&exists, 0, 0.0);
  }

  /// Makes room for joints; none yet.
  void SetJointed() {
    const Quat<T> straight{1.0, 0.0, 0.0, 0.0};
    joints.assign(layout.chain_elements, {straight, straight});
  }

  /// Makes room for the tangents of section laws; none yet.
  void SetNonlinear() {
    if (!law_diagonal.empty()) return;
    law_diagonal.resize(nodes.size());
    law_lower.resize(nodes.size());
  }

  /// Which end nodes of the rods are held.
  void SetHeld(bool a, bool b) {
    const int end = layout.chain_elements;
    first = end + 1;
    last = -1;
    mixed_below = 0;
    for (int k = 0; k <= end; ++k) {
      T free_lanes(0.0);
      int free_count = 0;
      for (int l = 0; l < kLaneCount<T>; ++l) {
        const int i = layout.NodeAt(k, l);
        if (i < 0 || (i == 0 && a) || (i == layout.elements && b)) continue;
        SetLane(&free_lanes, l, 1.0);
        ++free_count;
      }
      if (free_count == 0) continue;
      first = std::min(first, k);
      last = k;
      if (free_count == kLaneCount<T>) continue;
      free[k] = free_lanes;  // happens at a rod's ends only
      mixed_below = k + 1;
    }
  }

  ChainLayout layout;
  int first = 0, last = -1;  // of the entries that are free in any lane
  // Entries below this are held in some lanes, where `free` is 0, and free in others, where it
  // is 1.
  int mixed_below = 0;
  T free[2] = {1.0, 1.0};
  T exists = 1.0;   // 0 where the first element is nowhere
  Vec3<T> gravity;  // [m/s^2]
  ElementLaw<T> law{};
  ChainShearLaw<T> shear_law;
  Vec3<T> unbend;         // what an unstressed curvature adds to the moment [N m]
  bool branched = false;  // whether any rod's section has more than its Kelvin-Voigt elements

  std::vector<ChainState<T>> state;
  Persistence<T> persistence;
  std::vector<ChainShear<T>> shear, next_shear;  // the latter is of a step that is being accepted
  // The elements' tensions that the law of the step is evaluated at, at least 0 [N], and those of
  // the next one; where any matters, what they make of the laws of the step.
  std::vector<T> tension, next_tension;
  bool taut = false;
  std::vector<Stiffening<T>> stiffening;
  std::vector<ScaledLaw<T>> taut_laws;

  std::vector<ChainNode<T>> nodes;
  std::vector<NodeMass<T>> masses;
  std::vector<ShearOffset<T>> shear_offsets;
  std::vector<ElementOffset<T>> branch_offsets;  // only where `branched`; those of laws as well
  std::vector<ElementJoint<T>> joints;           // none of rods without joints
  std::vector<ChainStrain<T>> strains;           // found when asked for
  T dissipation = 0.0;                           // of the accepted iterate [W]
  Vec6<T> missing_first[2], missing_last;        // what its end nodes lack to balance

  Elimination<Quick<T>> quick;
  Elimination<T> exact;  // where quick does not do

  // What loads add, where there are any: to the right-hand side, to the nodes' own blocks of the
  // tangent, and to the symmetric block of two nodes' positions.
  bool loaded = false;
  std::vector<Vec6<T>> load_rhs;
  std::vector<Triangle6<T>> load_diagonal;
  std::vector<Mat3<T>> load_lower;

  // Whether any rod's section has laws that are not linear over a step; what those add to the
  // nodes' own blocks of the tangent, and to the block of an entry's node (rows) and the next.
  bool nonlinear = false;
  std::vector<Triangle6<T>> law_diagonal;
  std::vector<Block6<T>> law_lower;

  // Whether some element may be turned too far for the series of its functions.
  bool careful = false;
};

}  // namespace cosserat_cable::rod
