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

/// What section laws add.
template <class T, class F>
void AddLawDiagonal(const StepChain<T>& w, int k, Triangle6<F>* s) {
  if (!w.nonlinear) return;
  for (int i = 0; i < 21; ++i) s->v[i] += Converted<F>(w.law_diagonal[k].v[i]);
}
template <class T, class F>
void AddLawCoupling(const StepChain<T>& w, int e, F coupling[6][6]) {
  if (!w.nonlinear) return;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) coupling[i][j] += Converted<F>(w.law_lower[e][i][j]);
}

/// An element and its first node, evaluated: what the linear system needs of them.
template <class F>
struct Evaluated {
  ElementTangent<F> tangent;
  Vec6<F> lacking;  // what the node lacks to balance
};

/// Evaluates elements and nodes one after the other: forces in full precision.
template <bool kJointed, class T, class F>
class Evaluation {
 public:
  Evaluation(const StepCoefficients& c, const StepChain<T>& chain)
      : w_(chain),
        law_(chain.law),
        velocity_by_increment_(c.velocity_by_increment),
        moduli_(ModuliOf(law_)) {
    for (T& x : on_next_.v) x = T(0.0);
  }

  void Element(int e, bool with_tangent, Evaluated<F>* out) {
    const ScaledLaw<T>& law = LawOf(w_, law_, e);
    ElementState<T> state = StateOf<kJointed>(w_, w_.nodes, e, law.bowing, &largest_);
    EvaluateStress(w_, law, e, &state);
    const ElementForces<T> forces = ForcesOf<kJointed>(w_, e, law.bowing, state);
    Vec6<T> own = OwnForces(w_, e);
    SubtractFromFirst(forces, &own);
    Finish(e, own, out);
    on_next_ = OnSecond(forces);
    if (e < w_.layout.padding)
      for (T& x : on_next_.v) x = w_.exists * x;
    if (!with_tangent) return;
    if (w_.taut) moduli_ = ModuliOf(law);
    out->tangent = EvaluateTangent(Converted<F>(state), moduli_);
    if constexpr (kJointed) TurnBack(Converted<F>(w_.joints[e]), &out->tangent);
  }
  void LastNode(Evaluated<F>* out) {
    const int k = w_.layout.chain_elements;
    Finish(k, OwnForces(w_, k), out);
  }

  /// Square of the largest of the elements' Rodrigues vectors.
  const T& largest() const { return largest_; }

 private:
  TangentLaw<F> ModuliOf(const ScaledLaw<T>& law) const {
    return {Converted<F>(law.bowing), Converted<F>(law.C_F + velocity_by_increment_ * law.V_F),
            Converted<F>(law.C_M + velocity_by_increment_ * law.V_M)};
  }
  void Finish(int k, Vec6<T> own, Evaluated<F>* out) {
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) {
      own[i] -= on_next_[i];
      if (w_.loaded) own[i] += w_.load_rhs[k][i];
      out->lacking[i] = Converted<F>(own[i]);
    }
  }

  const StepChain<T>& w_;
  const ScaledLaw<T> law_;
  const T velocity_by_increment_;
  TangentLaw<F> moduli_;  // of the element at hand; of all where none is taut
  T largest_ = 0.0;
  Vec6<T> on_next_;  // what the last element exerts on its second node
};

/// The block-tridiagonal system's elimination, node after node.
template <class T, class F>
class Eliminator {
 public:
  Eliminator(const StepCoefficients& c, const StepChain<T>& chain, Elimination<F>* solver,
             const F& smallest)
      : w_(chain), solver_(*solver), rate_by_increment_(c.rate_by_increment), pivot_(smallest) {
    for (F& x : block_.v) x = F(0.0);
    for (F& x : carried_.v) x = F(0.0);
  }

  /// Factorises node `e`'s block, complete with what element `e` adds to it.
  void Factorise(int e, const ElementTangent<F>& tangent) {
    AddInertia(rate_by_increment_, w_.masses[e], &block_);
    AddToFirst(tangent, &block_);
    if (e < w_.first) return;
    AddLoadDiagonal(w_, e, &block_);
    AddLawDiagonal(w_, e, &block_);
    NodeFactor<F>& factor = solver_.factors[e];
    F lowest = pivot_;
    FactoriseNode(block_, &factor, &lowest);
    if (e < w_.mixed_below) {  // where a node is held, it takes nothing and does not move
      const F free = Converted<F>(w_.free[e]);
      for (F& x : factor.inverse) x = free * x;
      lowest = free * lowest + (1.0 - free) * pivot_;
    }
    pivot_ = lowest;
  }
  /// Begins the next node's block with what element `e` adds to it, less what is eliminated.
  void Couple(int e, const ElementTangent<F>& tangent) {
    SetAtSecond(tangent, &block_);
    if (e < w_.layout.padding) {
      const F exists = Converted<F>(w_.exists);
      for (F& x : block_.v) x = exists * x;
    }
    if (e < w_.first) return;
    F coupling[6][6];
    Coupling(tangent, coupling);
    AddLoadCoupling(w_, e, coupling);
    AddLawCoupling(w_, e, coupling);
    CoupleNode(coupling, &solver_.factors[e], &block_);
  }
  void Substitute(int e, const Vec6<F>& lacking) {
    if (e < w_.first) return;
    Vec6<F> b = Sum(lacking), next;
    for (F& x : next.v) x = F(0.0);
    SubstituteNode(solver_.factors[e], &b, &next);
    solver_.rhs[e] = b;
    carried_ = next;
  }

  /// The last node, which has no element after it; of a rod in halves it is both halves'.
  void FactoriseLast() {
    const int last = w_.layout.chain_elements;
    AddInertia(rate_by_increment_, w_.masses[last], &block_);
    AddLoadDiagonal(w_, last, &block_);
    AddLawDiagonal(w_, last, &block_);
    for (F& x : block_.v) Join(&x);
    NodeFactor<F>& factor = solver_.factors[last];
    FactoriseNode(block_, &factor, &pivot_);
    for (auto& row : factor.gain)
      for (F& x : row) x = F(0.0);
  }
  void SubstituteLast(const Vec6<F>& lacking) {
    const int last = w_.layout.chain_elements;
    Vec6<F> b = Sum(lacking), nobody = b;
    for (F& x : b.v) Join(&x);
    SubstituteNode(solver_.factors[last], &b, &nobody);
    solver_.rhs[last] = b;
  }

  const F& smallest() const { return pivot_; }

 private:
  Vec6<F> Sum(const Vec6<F>& lacking) const {
    Vec6<F> sum;
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) sum[i] = lacking[i] + carried_[i];
    return sum;
  }

  const StepChain<T>& w_;
  Elimination<F>& solver_;
  const F rate_by_increment_;
  F pivot_;
  Triangle6<F> block_;  // of the node that is next to be factorised
  Vec6<F> carried_;     // what its right-hand side gets from those before
};

/// False where it has to be done again, now with the exact functions where the series are not.
template <bool kJointed, class T, class F>
bool EliminateForwardOf(const StepCoefficients& c, bool fresh, StepChain<T>* w,
                        Elimination<F>* solver, F* smallest) {
  const int elements = w->layout.chain_elements;
  Evaluation<kJointed, T, F> evaluation(c, *w);
  Eliminator<T, F> eliminator(c, *w, solver, *smallest);
  Evaluated<F> evaluated[2];
  evaluation.Element(0, fresh, &evaluated[0]);
  for (int e = 0; e < elements; ++e) {
    Evaluated<F>&now = evaluated[e % 2], &next = evaluated[(e + 1) % 2];
    if (fresh) eliminator.Factorise(e, now.tangent);
    // Between these two, whose operations wait for each other, the processor has this to do.
    if (e + 1 < elements) evaluation.Element(e + 1, fresh, &next);
    if (fresh) eliminator.Couple(e, now.tangent);
    eliminator.Substitute(e, now.lacking);
  }
  if (w->last == elements) {
    evaluation.LastNode(&evaluated[elements % 2]);
    if (fresh) eliminator.FactoriseLast();
    eliminator.SubstituteLast(evaluated[elements % 2].lacking);
  }
  if (!w->careful && AnyAtLeast(evaluation.largest(), kArcTangentSeriesBelow)) {
    w->careful = true;
    return false;
  }
  *smallest = eliminator.smallest();
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
#define COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(KERNEL, T, F)                                       \
  KERNEL                                                                                       \
  void EliminateUnjointed(const StepCoefficients& c, bool fresh, StepChain<T>* w,              \
                          Elimination<F>* solver, F* smallest) {                               \
    while (!EliminateForwardOf<false>(c, fresh, w, solver, smallest)) continue;                \
  }                                                                                            \
  void EliminateForward(const StepCoefficients& c, bool fresh, StepChain<T>* w,                \
                        Elimination<F>* solver, F* smallest) {                                 \
    if (w->joints.empty()) return EliminateUnjointed(c, fresh, w, solver, smallest);           \
    while (!EliminateForwardOf<true>(c, fresh, w, solver, smallest)) continue;                 \
  }                                                                                            \
  KERNEL                                                                                       \
  void CorrectBackward(const StepCoefficients& c, const T& keep, const Elimination<F>& solver, \
                       StepChain<T>* w, ChainCorrection<T>* size) {                            \
    CorrectBackwardOf(c, keep, solver, w, size);                                               \
  }

COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(COSSERAT_CABLE_KERNEL, WideLanes, Quick<WideLanes>)
COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(COSSERAT_CABLE_KERNEL, WideLanes, WideLanes)
COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(COSSERAT_CABLE_KERNEL, Lanes, Quick<Lanes>)
COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(COSSERAT_CABLE_KERNEL, Lanes, Lanes)
COSSERAT_CABLE_DEFINE_CHAIN_SOLVER(COSSERAT_CABLE_KERNEL, LanePair, LanePair)

}  // namespace cosserat_cable::rod
