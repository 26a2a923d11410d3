#include "chain_kernels.h"

#include <algorithm>
#include <cstring>

#include "cosserat_cable/math/kernel.h"

namespace cosserat_cable::rod {
namespace {

// ---- Records of doubles of several rods, in and out of lanes.
// ------------------------------------

template <int N>
typename BasicLanes<N>::Vector Load(const double* from) {
  typename BasicLanes<N>::Vector v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
template <int N>
void Store(const typename BasicLanes<N>::Vector& v, double* to) {
  std::memcpy(to, &v, sizeof v);
}

using Vector2 = LanePair::Vector;
using Vector4 = Lanes::Vector;

inline void Transpose(Vector2* v) {
  const Vector2 a = v[0], b = v[1];
  v[0] = __builtin_shufflevector(a, b, 0, 2);
  v[1] = __builtin_shufflevector(a, b, 1, 3);
}
inline void Transpose(Vector4* v) {
  const Vector4 a = __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6);
  const Vector4 b = __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7);
  const Vector4 c = __builtin_shufflevector(v[2], v[3], 0, 4, 2, 6);
  const Vector4 d = __builtin_shufflevector(v[2], v[3], 1, 5, 3, 7);
  v[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  v[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  v[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  v[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

// A record is a struct of nothing but doubles, or of nothing but lanes; it is at least as long as
// there are lanes, up to four. The last transposition overlaps the one before where the lengths do
// not divide.
constexpr int kLongestRecord = 13;
template <class Record, int N>
constexpr int kLength = sizeof(Record) / sizeof(BasicLanes<N>);

template <int N, class One>
void GatherDoubles(int count, const One* const* from, BasicLanes<N>* to) {
#pragma GCC unroll 16
  for (int start = 0; start < count; start += N) {
    const int at = start + N <= count ? start : count - N;
    typename BasicLanes<N>::Vector v[N];
#pragma GCC unroll 8
    for (int l = 0; l < N; ++l) v[l] = Load<N>(reinterpret_cast<const double*>(from[l]) + at);
    Transpose(v);
#pragma GCC unroll 8
    for (int l = 0; l < N; ++l) to[at + l].v = v[l];
  }
}
// Eight rods as two times four: a record may be shorter than eight.
template <class One>
void GatherDoubles(int count, const One* const* from, WideLanes* to) {
  Lanes low[kLongestRecord], high[kLongestRecord];
  GatherDoubles(count, from, low);
  GatherDoubles(count, from + 4, high);
#pragma GCC unroll 16
  for (int k = 0; k < count; ++k)
    to[k].v = __builtin_shufflevector(low[k].v, high[k].v, 0, 1, 2, 3, 4, 5, 6, 7);
}

template <int N, class One>
void ScatterDoubles(int count, const BasicLanes<N>* from, One* const* to) {
#pragma GCC unroll 16
  for (int start = 0; start < count; start += N) {
    const int at = start + N <= count ? start : count - N;
    typename BasicLanes<N>::Vector v[N];
#pragma GCC unroll 8
    for (int l = 0; l < N; ++l) v[l] = from[at + l].v;
    Transpose(v);
#pragma GCC unroll 8
    for (int l = 0; l < N; ++l) Store<N>(v[l], reinterpret_cast<double*>(to[l]) + at);
  }
}
template <class One>
void ScatterDoubles(int count, const WideLanes* from, One* const* to) {
  Lanes low[kLongestRecord], high[kLongestRecord];
#pragma GCC unroll 16
  for (int k = 0; k < count; ++k) {
    low[k].v = __builtin_shufflevector(from[k].v, from[k].v, 0, 1, 2, 3);
    high[k].v = __builtin_shufflevector(from[k].v, from[k].v, 4, 5, 6, 7);
  }
  ScatterDoubles(count, low, to);
  ScatterDoubles(count, high, to + 4);
}

template <int N, class One, class All>
void GatherRecord(const One* const* from, All* to) {
  constexpr int kCount = kLength<All, N>;
  static_assert(sizeof(One) == kCount * sizeof(double));
  static_assert(kCount >= std::min(N, 4) && kCount <= kLongestRecord);
  GatherDoubles(kCount, from, reinterpret_cast<BasicLanes<N>*>(to));
}

template <int N, class One, class All>
void ScatterRecord(const All& from, One* const* to) {
  constexpr int kCount = kLength<All, N>;
  static_assert(sizeof(One) == kCount * sizeof(double));
  static_assert(kCount >= std::min(N, 4) && kCount <= kLongestRecord);
  ScatterDoubles(kCount, reinterpret_cast<const BasicLanes<N>*>(&from), to);
}

// ---- Predict
// -------------------------------------------------------------------------------------

template <int N>
bool AnyAtLeast(const BasicLanes<N>& x, double limit) {
  bool any = false;
  for (int l = 0; l < N; ++l) any |= x[l] >= limit;
  return any;
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

template <int N>
void PredictOf(const StepCoefficients& c, const RodState* rods, StepChain<BasicLanes<N>>* w) {
  using T = BasicLanes<N>;
  T largest(0.0);
  const int count = static_cast<int>(w->nodes.size());
  for (int k = 0; k < count; ++k) {
    const Node<double>* node[N];
    const NodeRates<double>*rate[N], *algorithm[N];
#pragma GCC unroll 8
    for (int l = 0; l < N; ++l) {
      const int at = w->layout.NodeAt(k, l), i = at < 0 ? 0 : at;
      node[l] = rods[l].node + i;
      rate[l] = rods[l].rate + i;
      algorithm[l] = rods[l].algorithm + i;
    }
    Node<T> from;
    NodeRates<T> rate0, a0;
    GatherRecord<N>(node, &from);
    GatherRecord<N>(rate, &rate0);
    GatherRecord<N>(algorithm, &a0);
    ChainNode<T>& to = w->nodes[k];
    NodeRates<T>& past = w->past[k];
    to.q0 = from.q;
    to.turn = c.dt * from.omega;
    to.at.r = from.r + c.dt * from.v;
    to.at.v = from.v + c.coasting_velocity * a0.v;
    to.at.omega = from.omega + c.coasting_velocity * a0.omega;
    past.v = c.old_algorithm * a0.v + c.old_rate * rate0.v;
    past.omega = c.old_algorithm * a0.omega + c.old_rate * rate0.omega;
    to.rate.v = past.v + c.coasting_rate * a0.v;
    to.rate.omega = past.omega + c.coasting_rate * a0.omega;
    largest = Max(largest, TurnNode(&to));
  }
  if (AnyAtLeast(largest, kExpSeriesBelow)) CorrectTurns(w);
}

// ---- Forces and elimination
// ----------------------------------------------------------------------

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

template <class T>
void AddInertia(const StepCoefficients& c, const NodeMass<T>& lump, Triangle6<T>* s) {
  const T m = c.rate_by_increment * lump.mass;
  s->at(0, 0) += m;
  s->at(1, 1) += m;
  s->at(2, 2) += m;
  s->at(3, 3) += c.rate_by_increment * lump.inertia.x;
  s->at(4, 4) += c.rate_by_increment * lump.inertia.y;
  s->at(5, 5) += c.rate_by_increment * lump.inertia.z;
}

/// Sums the two halves in their common node.
inline void Join(LanePair* x) { x->v += __builtin_shufflevector(x->v, x->v, 1, 0); }
template <int N>
void Join(BasicLanes<N>*) {}

/// The nodes as the element between them sees them; kJointed: whether any rod has joints.
template <bool kJointed, class T>
struct ElementEnds {
  ElementEnds(const StepChain<T>& w, int e) : a(w.nodes[e].at), b(w.nodes[e + 1].at) {}
  const Node<T>&a, &b;
};
template <class T>
struct ElementEnds<true, T> {
  ElementEnds(const StepChain<T>& w, int e)
      : a(SeenThrough(w.joints[e].first, w.nodes[e].at)),
        b(SeenThrough(w.joints[e].second, w.nodes[e + 1].at)) {}
  const Node<T> a, b;
};

template <bool kJointed, class T>
ElementState<T> StateOf(const StepChain<T>& w, int e, T* largest) {
  ElementState<T> state;
  const ElementEnds<kJointed, T> ends(w, e);
  const Node<T>&a = ends.a, &b = ends.b;
  const RelativeTurn<T> turn = EvaluateTurn(a.q, b.q, &state.Rm);
  ArcTangentSeries<T> series = SumArcTangentSeries(turn.x2);
  *largest = Max(*largest, turn.x2);
  if (w.careful) {
    ArcTangentSeries<T> corrected = series;
    CorrectArcTangent(turn.x2, &corrected);
    series = corrected;
  }
  EvaluateStrain(a, b, turn, series, &state);
  return state;
}

template <bool kJointed, class T>
ElementForces<T> ForcesOf(const StepChain<T>& w, int e, const ElementState<T>& state) {
  ElementForces<T> forces = EvaluateForces(state);
  if constexpr (kJointed) TurnBack(w.joints[e], &forces);
  return forces;
}

/// False where it has to be done again, now with the exact functions where the series are not.
template <bool kJointed, class T>
bool EliminateForwardOf(const StepCoefficients& c, bool fresh, StepChain<T>* chain, T* smallest) {
  StepChain<T>& w = *chain;
  const int first = w.first, last = w.last, elements = w.layout.chain_elements;
  const ScaledLaw<T> law(w.law);
  const TangentLaw<T> moduli(w.law.h, w.law.C_F + c.velocity_by_increment * w.law.V_F,
                             w.law.C_M + c.velocity_by_increment * w.law.V_M);

  T largest(0.0), pivot = *smallest;
  Vec6<T> b = OwnForces(w, 0);
  Triangle6<T> blocks[2];  // the current node's and the next one's, in turn
  for (T& x : blocks[0].v) x = T(0.0);
  AddInertia(c, w.masses[0], &blocks[0]);

  for (int e = 0; e < elements; ++e) {
    ElementState<T> state = StateOf<kJointed>(w, e, &largest);
    EvaluateStress(law, w.offsets[e], &state);
    const ElementForces<T> forces = ForcesOf<kJointed>(w, e, state);
    SubtractFromFirst(forces, &b);
    Vec6<T> b_next = OwnForces(w, e + 1);
    const Vec6<T> on_second = OnSecond(forces);
    const bool nowhere = e < w.layout.padding;
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) b_next[k] -= nowhere ? w.exists * on_second[k] : on_second[k];

    NodeFactor<T>& factor = w.factors[e];
    if (fresh) {
      ElementTangent<T> tangent = EvaluateTangent(state, moduli);
      if constexpr (kJointed) TurnBack(w.joints[e], &tangent);
      Triangle6<T>&s = blocks[e % 2], &next = blocks[(e + 1) % 2];
      AddToFirst(tangent, &s);
      SetAtSecond(tangent, &next);
      if (nowhere)
        for (T& x : next.v) x = w.exists * x;
      AddInertia(c, w.masses[e + 1], &next);
      if (e >= first) {
        T coupling[6][6];
        Coupling(tangent, coupling);
        if (w.loaded) {
          for (int k = 0; k < 21; ++k) s.v[k] += w.load_diagonal[e].v[k];
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) coupling[i][j] += w.load_lower[e][i][j];
        }
        T lowest = pivot;
        FactoriseNode(s, &factor, &lowest);
        if (e < w.mixed_below) {  // where a node is held, it takes nothing and does not move
          const T& free = w.free[e];
          for (T& x : factor.inverse) x = free * x;
          lowest = free * lowest + (1.0 - free) * pivot;
        }
        pivot = lowest;
        CoupleNode(coupling, &factor, &next);
      }
    }
    if (e >= first) {
      if (w.loaded)
        for (int k = 0; k < 6; ++k) b[k] += w.load_rhs[e][k];
      SubstituteNode(factor, &b, &b_next);
      w.rhs[e] = b;
    }
    b = b_next;
  }
  if (last == elements) {
    NodeFactor<T>& factor = w.factors[last];
    if (w.loaded)
      for (int k = 0; k < 6; ++k) b[k] += w.load_rhs[last][k];
    for (int k = 0; k < 6; ++k) Join(&b[k]);
    if (fresh) {
      Triangle6<T>& s = blocks[last % 2];
      if (w.loaded)
        for (int k = 0; k < 21; ++k) s.v[k] += w.load_diagonal[last].v[k];
      for (T& x : s.v) Join(&x);
      FactoriseNode(s, &factor, &pivot);
      for (auto& row : factor.gain)
        for (T& x : row) x = T(0.0);
    }
    Vec6<T> nobody = b;
    SubstituteNode(factor, &b, &nobody);
    w.rhs[last] = b;
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
template <class T>
void CorrectBackwardOf(const StepCoefficients& c, const T& keep, StepChain<T>* w,
                       ChainCorrection<T>* size) {
  T translation(0.0), rotation(0.0), sum(0.0), largest(0.0);
  Vec6<T> next;
  for (T& x : next.v) x = T(0.0);
  for (int k = w->last; k >= w->first; --k) {
    next = SolveNode(w->factors[k], w->rhs[k], next);
    const Vec3<T> dr = keep * Vec3<T>{next[0], next[1], next[2]};
    const Vec3<T> phi = keep * Vec3<T>{next[3], next[4], next[5]};
    const Vec3<T> moved = Scale(dr, dr), turned = Scale(phi, phi);
    translation = Max(Max(translation, moved.x), Max(moved.y, moved.z));
    rotation = Max(Max(rotation, turned.x), Max(turned.y, turned.z));
    // A maximum may lose a NaN, a sum does not.
    sum += (moved.x + moved.y + moved.z) + (turned.x + turned.y + turned.z);

    ChainNode<T>& node = w->nodes[k];
    const Vec3<T> across = Cross(node.turn, phi);
    const Vec3<T> d = phi + T(0.5) * across + T(1.0 / 12) * Cross(node.turn, across);
    node.at.r += dr;
    node.at.v += c.velocity_by_increment * dr;
    node.rate.v += c.rate_by_increment * dr;
    node.turn += d;
    node.at.omega += c.velocity_by_increment * d;
    node.rate.omega += c.rate_by_increment * d;
    largest = Max(largest, TurnNode(&node));
  }
  *size = {translation, rotation, sum};
  if (AnyAtLeast(largest, kExpSeriesBelow)) CorrectTurns(w);
}

// ---- What is kept of a step
// ----------------------------------------------------------------------

template <class T>
void Subtract(const Vec6<T>& x, Vec6<T>* from) {
  for (int k = 0; k < 6; ++k) (*from)[k] -= x[k];
}

template <bool kJointed, class T>
bool EvaluateAcceptedOf(StepChain<T>* chain) {
  StepChain<T>& w = *chain;
  const int elements = w.layout.chain_elements, padding = w.layout.padding;
  const ScaledLaw<T> law(w.law);
  T largest(0.0), dissipation(0.0);
  for (int e = 0; e < elements; ++e) {
    ElementState<T> state = StateOf<kJointed>(w, e, &largest);
    w.strains[e] = {state.u, state.u_rate, state.theta, state.theta_rate};
    const T lost = law.V_F.z * state.u_rate.z * state.u_rate.z +
                   Dot(Scale(law.V_M, state.theta_rate), state.theta_rate);
    dissipation += e < padding ? w.exists * lost : lost;
    if (e > padding && e < elements - 1) continue;
    EvaluateStress(law, w.offsets[e], &state);
    const ElementForces<T> forces = ForcesOf<kJointed>(w, e, state);
    if (e <= padding) {
      w.missing_first[e] = OwnForces(w, e);
      SubtractFromFirst(forces, &w.missing_first[e]);
    }
    w.missing_last = OwnForces(w, e + 1);
    Subtract(OnSecond(forces), &w.missing_last);
    if (e == 0 && elements == padding) {
      // One element: its first node is where the halves meet, and has nothing from the one nowhere.
      w.missing_first[1] = OwnForces(w, 1);
      for (int k = 0; k < 6; ++k) {
        T sum = w.missing_first[1][k] - w.exists * OnSecond(forces)[k];
        Join(&sum);
        w.missing_first[1][k] = sum;
      }
    }
  }
  if (!w.careful && AnyAtLeast(largest, kArcTangentSeriesBelow)) {
    w.careful = true;
    return false;
  }
  w.dissipation = dissipation;
  return true;
}

/// Of a unit quaternion but for rounding, which would add up over many steps.
template <class T>
Quat<T> Renormalised(const Quat<T>& q) {
  const T s = 1.5 - 0.5 * Dot(q, q);
  return {s * q.w, s * q.x, s * q.y, s * q.z};
}

template <int N>
void AcceptOf(const StepCoefficients& c, const StepChain<BasicLanes<N>>& w,
              const RodState* const* rods) {
  using T = BasicLanes<N>;
  Node<double> no_node[N];
  NodeRates<double> no_rates[N];
  const int count = static_cast<int>(w.nodes.size());
  for (int k = 0; k < count; ++k) {
    Node<double>* node[N];
    NodeRates<double>* rate[N];
    NodeRates<double>* algorithm[N];
#pragma GCC unroll 8
    for (int l = 0; l < N; ++l) {
      const int i = w.layout.NodeAt(k, l);
      const bool wanted = rods[l] && i >= 0;
      node[l] = wanted ? rods[l]->node + i : &no_node[l];
      rate[l] = wanted ? rods[l]->rate + i : &no_rates[l];
      algorithm[l] = wanted ? rods[l]->algorithm + i : &no_rates[l];
    }
    const ChainNode<T>& from = w.nodes[k];
    const NodeRates<T>& past = w.past[k];
    const NodeRates<T> a{c.algorithm_by_rate * (from.rate.v - past.v),
                         c.algorithm_by_rate * (from.rate.omega - past.omega)};
    ScatterRecord<N>(a, algorithm);
    ScatterRecord<N>(from.rate, rate);
    Node<T> to = from.at;
    to.q = Renormalised(to.q);
    ScatterRecord<N>(to, node);
  }
}

}  // namespace

// Joints are rare: with them, the loops are compiled once, for the oldest machine.
#define COSSERAT_CABLE_DEFINE_CHAIN_KERNELS(KERNEL, T)                                           \
  KERNEL                                                                                         \
  void Predict(const StepCoefficients& c, const RodState* rods, StepChain<T>* w) {               \
    PredictOf(c, rods, w);                                                                       \
  }                                                                                              \
  KERNEL                                                                                         \
  void EliminateUnjointed(const StepCoefficients& c, bool fresh, StepChain<T>* w, T* smallest) { \
    while (!EliminateForwardOf<false>(c, fresh, w, smallest)) continue;                          \
  }                                                                                              \
  void EliminateForward(const StepCoefficients& c, bool fresh, StepChain<T>* w, T* smallest) {   \
    if (w->joints.empty()) return EliminateUnjointed(c, fresh, w, smallest);                     \
    while (!EliminateForwardOf<true>(c, fresh, w, smallest)) continue;                           \
  }                                                                                              \
  KERNEL                                                                                         \
  void CorrectBackward(const StepCoefficients& c, const T& keep, StepChain<T>* w,                \
                       ChainCorrection<T>* size) {                                               \
    CorrectBackwardOf(c, keep, w, size);                                                         \
  }                                                                                              \
  KERNEL                                                                                         \
  void EvaluateUnjointed(StepChain<T>* w) {                                                      \
    while (!EvaluateAcceptedOf<false>(w)) continue;                                              \
  }                                                                                              \
  void EvaluateAccepted(StepChain<T>* w) {                                                       \
    if (w->joints.empty()) return EvaluateUnjointed(w);                                          \
    while (!EvaluateAcceptedOf<true>(w)) continue;                                               \
  }                                                                                              \
  KERNEL                                                                                         \
  void Accept(const StepCoefficients& c, const StepChain<T>& w, const RodState* const* rods) {   \
    AcceptOf(c, w, rods);                                                                        \
  }

COSSERAT_CABLE_DEFINE_CHAIN_KERNELS(COSSERAT_CABLE_WIDE_KERNEL, WideLanes)
COSSERAT_CABLE_DEFINE_CHAIN_KERNELS(COSSERAT_CABLE_KERNEL, Lanes)
COSSERAT_CABLE_DEFINE_CHAIN_KERNELS(COSSERAT_CABLE_KERNEL, LanePair)

}  // namespace cosserat_cable::rod
