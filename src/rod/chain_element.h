// Nodes and elements of a chain, one at a time: what its sweeps have in common.
#pragma once

#include "rotation_kernel.h"
#include "step_chain.h"

namespace cosserat_cable::rod {

/// Gravity and inertia.
template <class T>
Vec6<T> OwnForces(const StepChain<T>& w, int k) {
  const ChainNode<T>& node = w.nodes[k];
  const NodeMass<T>& lump = w.masses[k];
  const Vec3<T> f = lump.mass * (w.gravity - node.rate.v);
  const Vec3<T>& omega = node.at.omega;
  const Vec3<T> g = Scale(lump.inertia, node.rate.omega) + Cross(omega, Scale(lump.inertia, omega));
  return {{f.x, f.y, f.z, -g.x, -g.y, -g.z}};
}

template <class T>
void SubtractFromFirst(const ElementForces<T>& k, Vec6<T>* b) {
  (*b)[0] += k.f.x;
  (*b)[1] += k.f.y;
  (*b)[2] += k.f.z;
  (*b)[3] -= k.g1.x;
  (*b)[4] -= k.g1.y;
  (*b)[5] -= k.g1.z;
}
template <class T>
Vec6<T> OnSecond(const ElementForces<T>& k) {
  return {{k.f.x, k.f.y, k.f.z, k.g2.x, k.g2.y, k.g2.z}};
}

/// Sums the two halves in their common node.
inline void Join(LanePair* x) { x->v += __builtin_shufflevector(x->v, x->v, 1, 0); }
template <int N, class S>
void Join(BasicLanes<N, S>*) {}

/// Two nodes as the element between them sees them; kJointed: whether any rod has joints.
template <bool kJointed, class T>
struct ElementEnds {
  ElementEnds(const StepChain<T>&, int, const Node<T>& first, const Node<T>& second)
      : a(first), b(second) {}
  const Node<T>&a, &b;
};
template <class T>
struct ElementEnds<true, T> {
  ElementEnds(const StepChain<T>& w, int e, const Node<T>& first, const Node<T>& second)
      : a(SeenThrough(w.joints[e].first, first)), b(SeenThrough(w.joints[e].second, second)) {}
  const Node<T> a, b;
};

/// The law of an element: its own where a tension has changed it.
template <class T>
const ScaledLaw<T>& LawOf(const StepChain<T>& w, const ScaledLaw<T>& slack, int e) {
  return w.taut ? w.taut_laws[e] : slack;
}

/// Strains of an element between its nodes in `nodes`: the iterate's, or the state's.
template <bool kJointed, class T, class Nodes>
ElementState<T> StateOf(const StepChain<T>& w, const Nodes& nodes, int e, const Bowing<T>& bowing,
                        T* largest) {
  ElementState<T> state;
  const ElementEnds<kJointed, T> ends(w, e, nodes[e].at, nodes[e + 1].at);
  const Node<T>&a = ends.a, &b = ends.b;
  const RelativeTurn<T> turn = EvaluateTurn(a.q, b.q, &state.Rm);
  ArcTangentSeries<T> series = SumArcTangentSeries(turn.x2);
  *largest = Max(*largest, turn.x2);
  if (w.careful) {
    ArcTangentSeries<T> corrected = series;
    CorrectArcTangent(turn.x2, &corrected);
    series = corrected;
  }
  EvaluateStrain(a, b, turn, series, bowing, &state);
  return state;
}

template <bool kJointed, class T>
ElementForces<T> ForcesOf(const StepChain<T>& w, int e, const Bowing<T>& bowing,
                          const ElementState<T>& state) {
  ElementForces<T> forces = EvaluateForces(state, bowing);
  if constexpr (kJointed) TurnBack(w.joints[e], &forces);
  return forces;
}

template <int N>
bool AnyAtLeast(const BasicLanes<N>& x, double limit) {
  bool any = false;
  for (int l = 0; l < N; ++l) any |= x[l] >= limit;
  return any;
}

/// Force and moment of the law of the step at strains that StateOf has set.
template <class T>
void EvaluateStress(const StepChain<T>& w, const ScaledLaw<T>& law, int e, ElementState<T>* state) {
  EvaluateSection(law, w.shear_offsets[e], w.unbend, state);
  if (w.branched) {
    state->n += w.branch_offsets[e].F;
    state->m += w.branch_offsets[e].M;
  }
  BowStress(law.bowing, state);
}

/// The attitude after the turns of the step, where a node has turned too far for the series.
template <int N>
void CorrectTurns(StepChain<BasicLanes<N>>* w) {
  for (ChainNode<BasicLanes<N>>& node : w->nodes) {
    const BasicLanes<N> y = 0.25 * Dot(node.turn, node.turn);
    Quat<BasicLanes<N>> turn = ExpSeries(node.turn, y);
    CorrectExp(node.turn, y, &turn);
    const Quat<BasicLanes<N>> q = node.q0 * turn;
    for (int l = 0; l < N; ++l) {
      if (y[l] < kExpSeriesBelow) continue;
      SetLane(&node.at.q.w, l, q.w[l]);
      SetLane(&node.at.q.x, l, q.x[l]);
      SetLane(&node.at.q.y, l, q.y[l]);
      SetLane(&node.at.q.z, l, q.z[l]);
    }
  }
}

/// Sets the attitude after the node's turn; returns the square of half of that.
template <class T>
T TurnNode(ChainNode<T>* node) {
  const T y = 0.25 * Dot(node->turn, node->turn);
  node->at.q = node->q0 * ExpSeries(node->turn, y);
  return y;
}

}  // namespace cosserat_cable::rod
