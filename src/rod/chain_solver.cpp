#include "chain_solver.h"

#include "chain_element.h"
#include "cosserat_cable/math/kernel.h"

namespace cosserat_cable::rod {
namespace {

template <class T>
void AddToFirst(const ElementTangent<T>& k, Triangle6<T>* s) {
#pragma GCC unroll 3
  for (int r = 0; r < 3; ++r) {
#pragma GCC unroll 3
    for (int c = 0; c <= r; ++c) {
      s->at(r, c) += k.rr[r][c];
      s->at(3 + r, 3 + c) += k.t11[r][c];
    }
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) s->at(3 + r, c) -= k.r1[c][r];
  }
}
template <class T>
void SetAtSecond(const ElementTangent<T>& k, Triangle6<T>* s) {
#pragma GCC unroll 3
  for (int r = 0; r < 3; ++r) {
#pragma GCC unroll 3
    for (int c = 0; c <= r; ++c) {
      s->at(r, c) = k.rr[r][c];
      s->at(3 + r, 3 + c) = k.t22[r][c];
    }
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) s->at(3 + r, c) = k.r2[c][r];
  }
}
/// Transpose of the block that couples the second node to the first.
template <class T>
void Coupling(const ElementTangent<T>& k, T w[6][6]) {
#pragma GCC unroll 3
  for (int r = 0; r < 3; ++r)
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      w[r][c] = -k.rr[r][c];
      w[r][3 + c] = -k.r2[r][c];
      w[3 + r][c] = k.r1[c][r];
      w[3 + r][3 + c] = k.t12[r][c];
    }
}

/// `rate_by_increment`: as in StepCoefficients, in every lane.
template <class T, class F>
void AddInertia(const F& rate_by_increment, const NodeMass<T>& lump, Triangle6<F>* s) {
  const F m = rate_by_increment * Converted<F>(lump.mass);
  const Vec3<F> j = rate_by_increment * Converted<F>(lump.inertia);
  s->at(0, 0) += m;
  s->at(1, 1) += m;
  s->at(2, 2) += m;
  s->at(3, 3) += j.x;
  s->at(4, 4) += j.y;
  s->at(5, 5) += j.z;
}

/// What the loads add to a node's right-hand side.
template <class T>
void AddLoadForces(const StepChain<T>& w, int k, Vec6<T>* b) {
  if (!w.loaded) return;
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) (*b)[i] += w.load_rhs[k][i];
}
template <class T, class F>
void AddLoadDiagonal(const StepChain<T>& w, int k, Triangle6<F>* s) {
  if (!w.loaded) return;
  for (int i = 0; i < 21; ++i) s->v[i] += Converted<F>(w.load_diagonal[k].v[i]);
}
template <class T, class F>
void AddLoadCoupling(const StepChain<T>& w, int e, F coupling[6][6]) {
  if (!w.loaded) return;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) coupling[i][j] += Converted<F>(w.load_lower[e][i][j]);
}

/// The sum of what a node lacks by itself and what the elimination of those before it carries over.
template <class T, class F>
Vec6<F> Summed(const Vec6<T>& own, const Vec6<F>& carried) {
  Vec6<F> sum;
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) sum[i] = Converted<F>(own[i]) + carried[i];
  return sum;
}

/// False where it has to be done again, now with the exact functions where the series are not.
template <bool kJointed, class T, class F>
bool EliminateForwardOf(const StepCoefficients& c, bool fresh, StepChain<T>* chain,
                        Elimination<F>* solver, F* smallest) {
  StepChain<T>& w = *chain;
  const int first = w.first, last = w.last, elements = w.layout.chain_elements;
  const ScaledLaw<T> law(w.law);
  const TangentLaw<F> moduli(Converted<F>(w.law.h),
                             Converted<F>(w.law.C_F + c.velocity_by_increment * w.law.V_F),
                             Converted<F>(w.law.C_M + c.velocity_by_increment * w.law.V_M));
  const F exists = Converted<F>(w.exists), rate_by_increment(c.rate_by_increment);

  T largest(0.0);
  F pivot = *smallest;
  Vec6<T> own = OwnForces(w, 0);
  Vec6<F> carried;
  for (F& x : carried.v) x = F(0.0);
  Triangle6<F> blocks[2];  // the current node's and the next one's, in turn
  for (F& x : blocks[0].v) x = F(0.0);
  AddInertia(rate_by_increment, w.masses[0], &blocks[0]);

  for (int e = 0; e < elements; ++e) {
    ElementState<T> state = StateOf<kJointed>(w, w.nodes, e, &largest);
    EvaluateStress(w, law, e, &state);
    const ElementForces<T> forces = ForcesOf<kJointed>(w, e, state);
    SubtractFromFirst(forces, &own);
    Vec6<T> own_next = OwnForces(w, e + 1);
    const Vec6<T> on_second = OnSecond(forces);
    const bool nowhere = e < w.layout.padding;
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) own_next[k] -= nowhere ? w.exists * on_second[k] : on_second[k];

    NodeFactor<F>& factor = solver->factors[e];
    if (fresh) {
      ElementTangent<F> tangent = EvaluateTangent(Converted<F>(state), moduli);
      if constexpr (kJointed) TurnBack(Converted<F>(w.joints[e]), &tangent);
      Triangle6<F>&s = blocks[e % 2], &next = blocks[(e + 1) % 2];
      AddToFirst(tangent, &s);
      SetAtSecond(tangent, &next);
      if (nowhere)
        for (F& x : next.v) x = exists * x;
      AddInertia(rate_by_increment, w.masses[e + 1], &next);
      if (e >= first) {
        F coupling[6][6];
        Coupling(tangent, coupling);
        AddLoadDiagonal(w, e, &s);
        AddLoadCoupling(w, e, coupling);
        F lowest = pivot;
        FactoriseNode(s, &factor, &lowest);
        if (e < w.mixed_below) {  // where a node is held, it takes nothing and does not move
          const F free = Converted<F>(w.free[e]);
          for (F& x : factor.inverse) x = free * x;
          lowest = free * lowest + (1.0 - free) * pivot;
        }
        pivot = lowest;
        CoupleNode(coupling, &factor, &next);
      }
    }
    if (e >= first) {
      AddLoadForces(w, e, &own);
      Vec6<F> b = Summed(own, carried);
      for (F& x : carried.v) x = F(0.0);
      SubstituteNode(factor, &b, &carried);
      solver->rhs[e] = b;
    }
    own = own_next;
  }
  if (last == elements) {
    NodeFactor<F>& factor = solver->factors[last];
    AddLoadForces(w, last, &own);
    Vec6<F> b = Summed(own, carried);
    for (int k = 0; k < 6; ++k) Join(&b[k]);
    if (fresh) {
      Triangle6<F>& s = blocks[last % 2];
      AddLoadDiagonal(w, last, &s);
      for (F& x : s.v) Join(&x);
      FactoriseNode(s, &factor, &pivot);
      for (auto& row : factor.gain)
        for (F& x : row) x = F(0.0);
    }
    SubstituteNode(factor, &b, &carried);
    solver->rhs[last] = b;
  }
  if (!w.careful && AnyAtLeast(largest, kArcTangentSeriesBelow)) {
    w.careful = true;
    return false;
  }
  *smallest = pivot;
  return true;
}

// The system is solved for the variation phi in the section's frame; the step's rotation vector
// Theta changes by Jr(Theta)^{-1} phi = phi + Theta x phi/2 + Theta x (Theta x phi)/12. With that,
// the rates' tangent is `velocity_by_increment` times the strains' to first order in Theta: what
// both leave out cancels.
template <class T, class F>
void CorrectBackwardOf(const StepCoefficients& c, const T& keep, const Elimination<F>& solver,
                       StepChain<T>* w, ChainCorrection<T>* size) {
  const T velocity_by_increment(c.velocity_by_increment), rate_by_increment(c.rate_by_increment);
  T translation(0.0), rotation(0.0), largest(0.0);
  Vec6<F> next;
  for (F& x : next.v) x = F(0.0);
  for (int k = w->last; k >= w->first; --k) {
    next = SolveNode(solver.factors[k], solver.rhs[k], next);
    const Vec3<T> dr = keep * Converted<T>(Vec3<F>{next[0], next[1], next[2]});
    const Vec3<T> phi = keep * Converted<T>(Vec3<F>{next[3], next[4], next[5]});
    translation += Dot(dr, dr);
    rotation += Dot(phi, phi);

    ChainNode<T>& node = w->nodes[k];
    const Vec3<T> across = Cross(node.turn, phi);
    const Vec3<T> d = phi + T(0.5) * across + T(1.0 / 12) * Cross(node.turn, across);
    node.at.r += dr;
    node.at.v += velocity_by_increment * dr;
    node.rate.v += rate_by_increment * dr;
    node.turn += d;
    node.at.omega += velocity_by_increment * d;
    node.rate.omega += rate_by_increment * d;
    largest = Max(largest, TurnNode(&node));
  }
  *size = {translation, rotation};
  if (AnyAtLeast(largest, kExpSeriesBelow)) CorrectTurns(w);
}

}  // namespace

// Joints are rare: with them, the loops are compiled once, for the oldest machine.
#define COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(KERNEL, T, F)                                          \
  KERNEL                                                                                          \
  void EliminateUnjointed(const StepCoefficients& c, bool fresh, StepChain<T>* w,                 \
                          Elimination<F>* solver, F* smallest) {                                  \
    while (!EliminateForwardOf<false>(c, fresh, w, solver, smallest)) continue;                   \
  }                                                                                               \
  void EliminateForward(const StepCoefficients& c, bool fresh, StepChain<T>* w,                   \
                        Elimination<F>* solver, F* smallest) {                                    \
    if (w->joints.empty()) return EliminateUnjointed(c, fresh, w, solver, smallest);              \
    while (!EliminateForwardOf<true>(c, fresh, w, solver, smallest)) continue;                    \
  }                                                                                               \
  KERNEL                                                                                          \
  void CorrectBackward(const StepCoefficients& c, const T& keep, const Elimination<F>& solver,    \
                       StepChain<T>* w, ChainCorrection<T>* size) {                               \
    CorrectBackwardOf(c, keep, solver, w, size);                                                  \
  }

COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(COSSERAT_CABLE_WIDE_KERNEL, WideLanes, Quick<WideLanes>)
COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(COSSERAT_CABLE_WIDE_KERNEL, WideLanes, WideLanes)
COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(COSSERAT_CABLE_KERNEL, Lanes, Lanes)
COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(COSSERAT_CABLE_KERNEL, LanePair, LanePair)

}  // namespace cosserat_cable::rod
