#include "chain_advance.h"

#include <utility>

#include "chain_element.h"
#include "cosserat_cable/math/kernel.h"

namespace cosserat_cable::rod {
namespace {

/// What of a step's accelerations comes from its start.
template <class T>
NodeRates<T> PartOfPast(const StepCoefficients& c, const ChainState<T>& start) {
  const T old_algorithm(c.old_algorithm), old_rate(c.old_rate);
  return {old_algorithm * start.algorithm.v + old_rate * start.rate.v,
          old_algorithm * start.algorithm.omega + old_rate * start.rate.omega};
}

/// What the tensions make of the laws of the step.
template <class T>
void StiffenElements(StepChain<T>* chain) {
  StepChain<T>& w = *chain;
  T tightest(0.0);
  for (const T& tension : w.tension) tightest = Max(tightest, tension);
  w.taut = AnyAtLeast(tightest * Max(w.law.column.x.slenderness, w.law.column.y.slenderness),
                      kSlackBelow);
  if (!w.taut) return;
  const ScaledLaw<T> slack(w.law);
  for (int e = 0; e < w.layout.chain_elements; ++e) {
    w.stiffening[e] = EvaluateStiffening(w.law.column, w.tension[e]);
    w.taut_laws[e] = ScaledLaw<T>(slack, w.stiffening[e], w.shear_law.forwards);
  }
}

template <class T>
void PredictOf(const StepCoefficients& c, StepChain<T>* chain) {
  StepChain<T>& w = *chain;
  StiffenElements(&w);
  const T dt(c.dt), coasting_velocity(c.coasting_velocity), coasting_rate(c.coasting_rate);
  const T half_dt_squared(0.5 * c.dt * c.dt);
  const T by_mean = half_dt_squared * w.persistence.v;
  const T by_mean_omega = half_dt_squared * w.persistence.omega;
  const T velocity_by_increment(c.velocity_by_increment), rate_by_increment(c.rate_by_increment);
  T largest(0.0);
  const int count = static_cast<int>(w.nodes.size());
  for (int k = 0; k < count; ++k) {
    const ChainState<T>& from = w.state[k];
    ChainNode<T>& to = w.nodes[k];
    const Vec3<T> beyond = by_mean * from.mean.v;
    const Vec3<T> turn_beyond = by_mean_omega * from.mean.omega;
    to.q0 = from.at.q;
    to.turn = dt * from.at.omega + turn_beyond;
    to.at.r = from.at.r + (dt * from.at.v + beyond);
    to.at.v = from.at.v + coasting_velocity * from.algorithm.v + velocity_by_increment * beyond;
    to.at.omega = from.at.omega + coasting_velocity * from.algorithm.omega +
                  velocity_by_increment * turn_beyond;
    const NodeRates<T> past = PartOfPast(c, from);
    to.rate.v = past.v + coasting_rate * from.algorithm.v + rate_by_increment * beyond;
    to.rate.omega =
        past.omega + coasting_rate * from.algorithm.omega + rate_by_increment * turn_beyond;
    largest = Max(largest, TurnNode(&to));
  }
  if (AnyAtLeast(largest, kExpSeriesBelow)) CorrectTurns(&w);

  const ChainShearLaw<T> law = w.shear_law;
  for (int e = 0; e < w.layout.chain_elements; ++e)
    w.shear_offsets[e] = {law.forwards * law.x.Offset(w.shear[e].x),
                          law.forwards * law.y.Offset(w.shear[e].y)};
}

/// `next` in the lanes that are taken, `old` in the others, whatever is in either.
template <class T>
T Taken(const T& taken, const T& next, const T& old) {
  return T::Of(taken.v > 0.5 ? next.v : old.v);
}
template <class T>
Vec3<T> Taken(const T& taken, const Vec3<T>& next, const Vec3<T>& old) {
  return {Taken(taken, next.x, old.x), Taken(taken, next.y, old.y), Taken(taken, next.z, old.z)};
}
template <class T>
ChainState<T> Taken(const T& taken, const ChainState<T>& next, const ChainState<T>& old) {
  const auto rates = [&](const NodeRates<T>& a, const NodeRates<T>& b) {
    return NodeRates<T>{Taken(taken, a.v, b.v), Taken(taken, a.omega, b.omega)};
  };
  const Quat<T>&p = next.at.q, &q = old.at.q;
  return {{Taken(taken, next.at.r, old.at.r),
           {Taken(taken, p.w, q.w), Taken(taken, p.x, q.x), Taken(taken, p.y, q.y),
            Taken(taken, p.z, q.z)},
           Taken(taken, next.at.v, old.at.v),
           Taken(taken, next.at.omega, old.at.omega)},
          rates(next.rate, old.rate),
          rates(next.algorithm, old.algorithm),
          rates(next.mean, old.mean)};
}
template <class T>
ChainShear<T> Taken(const T& taken, const ChainShear<T>& next, const ChainShear<T>& old) {
  return {{Taken(taken, next.x.g1, old.x.g1), Taken(taken, next.x.G, old.x.G)},
          {Taken(taken, next.y.g1, old.y.g1), Taken(taken, next.y.G, old.y.G)}};
}

template <class T>
bool AllTaken(const T& taken) {
  bool all = true;
  for (int l = 0; l < kLaneCount<T>; ++l) all &= taken[l] > 0.5;
  return all;
}

/// Of a unit quaternion but for rounding, which would add up over many steps.
template <class T>
Quat<T> Renormalised(const Quat<T>& q) {
  const T s = 1.5 - 0.5 * Dot(q, q);
  return {s * q.w, s * q.x, s * q.y, s * q.z};
}

template <class T>
void Subtract(const Vec6<T>& x, Vec6<T>* from) {
  for (int k = 0; k < 6; ++k) (*from)[k] -= x[k];
}

/// What the nodes at the chain's ends lack to balance, as far as element `e` tells.
template <bool kJointed, class T>
void BalanceEnds(const ScaledLaw<T>& law, int e, ElementState<T> state, StepChain<T>* chain) {
  StepChain<T>& w = *chain;
  const int elements = w.layout.chain_elements, padding = w.layout.padding;
  if (e > padding && e < elements - 1) return;
  EvaluateStress(w, law, e, &state);
  const ElementForces<T> forces = ForcesOf<kJointed>(w, e, law.bowing, state);
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

template <class T>
ChainStrain<T> StrainOf(const ElementState<T>& state) {
  return {state.u, state.u_rate, state.theta, state.theta_rate};
}

/// What the next step's law is evaluated at, where the last one's was at `last` and `found` came
/// out. Of slack elements nothing depends on it.
template <class T>
T FollowedTension(const StepCoefficients& c, const StepChain<T>& w, const ScaledLaw<T>& law,
                  const ElementState<T>& state, const T& last, const T& found) {
  const BeamColumn<T>& column = w.law.column;
  const T pull = Max(found, T(0.0));
  const T slenderest = Max(last, pull) * Max(column.x.slenderness, column.y.slenderness);
  if (!AnyAtLeast(slenderest, kSlackBelow)) return pull;
  const T along = w.shear_law.forwards * state.chord.z;
  const T aside = Dot(state.chord, state.chord) * state.one_over_chord - along;
  const T stiffness = law.C_F.z + T(c.velocity_by_increment) * law.V_F.z;
  const T way = WayPerTension(column, Min(last, pull), {state.theta.x, state.theta.y}, aside);
  return pull + WhereAtLeast(slenderest, kSlackBelow, Followed(last, pull, way, stiffness) - pull);
}

/// False where it has to be done again, as EliminateForward.
template <bool kJointed, class T>
bool CommitElements(const StepCoefficients& c, const T& taken, StepChain<T>* chain) {
  StepChain<T>& w = *chain;
  const int elements = w.layout.chain_elements;
  const ScaledLaw<T> slack(w.law);
  const ChainShearLaw<T> shear = w.shear_law;
  const T h = w.law.h;
  const bool all = AllTaken(taken);
  T largest(0.0), dissipation(0.0);
  for (int e = 0; e < elements; ++e) {
    const ScaledLaw<T>& law = LawOf(w, slack, e);
    const ElementState<T> state = StateOf<kJointed>(w, w.nodes, e, law.bowing, &largest);
    if (w.branched) w.strains[e] = StrainOf(state);
    const T rate_x = shear.per_length * state.u_rate.x, rate_y = shear.per_length * state.u_rate.y;
    const ChainShear<T>& before = w.shear[e];
    ChainShear<T> now = {
        shear.x.Commit(before.x, shear.per_length * state.u.x - shear.gamma0.x, rate_x),
        shear.y.Commit(before.y, shear.per_length * state.u.y - shear.gamma0.y, rate_y)};
    T lost = law.V_F.z * state.u_rate.z * state.u_rate.z +
             Dot(Scale(law.V_M, state.theta_rate), state.theta_rate) +
             law.shear_V.x * state.u_rate.x * state.u_rate.x +
             law.shear_V.y * state.u_rate.y * state.u_rate.y +
             h * (shear.x.DissipationRate(now.x, rate_x) + shear.y.DissipationRate(now.y, rate_y));
    T tension =
        shear.forwards * (law.unstrained_F.z + law.C_F.z * state.u.z + law.V_F.z * state.u_rate.z);
    if (w.branched) tension += shear.forwards * w.branch_offsets[e].F.z;
    tension = FollowedTension(c, w, law, state, w.tension[e], tension);
    if (e < w.layout.padding) {
      now = Taken(w.exists, now, before);
      lost = w.exists * lost;
      tension = Taken(w.exists, tension, T(0.0));
    }
    dissipation += lost;
    w.next_shear[e] = all ? now : Taken(taken, now, before);
    w.next_tension[e] = all ? tension : Taken(taken, tension, w.tension[e]);
    BalanceEnds<kJointed>(law, e, state, &w);
  }
  if (!w.careful && AnyAtLeast(largest, kArcTangentSeriesBelow)) {
    w.careful = true;
    return false;
  }
  w.dissipation = dissipation;
  std::swap(w.shear, w.next_shear);
  std::swap(w.tension, w.next_tension);
  return true;
}

/// The part of vectors over a rod's nodes that would have foretold the ones that followed best.
template <class T>
class Foretold {
 public:
  void Add(const Vec3<T>& before, const Vec3<T>& now) {
    product_ += Dot(before, now);
    square_ += Dot(before, before);
  }
  T Part() {
    Join(&product_);
    Join(&square_);
    const T smallest(1e-100);  // of a rod at rest
    return Min(Max(product_ / Max(square_, smallest), T(0.0)), T(1.0));
  }

 private:
  T product_ = 0.0, square_ = 0.0;
};

template <class T>
void CommitNodes(const StepCoefficients& c, const T& taken, StepChain<T>* chain) {
  StepChain<T>& w = *chain;
  const T algorithm_by_rate(c.algorithm_by_rate), old_mean(c.old_mean), new_mean(c.new_mean);
  const bool all = AllTaken(taken);
  const int count = static_cast<int>(w.nodes.size());
  Foretold<T> foretold, foretold_omega;
  for (int k = 0; k < count; ++k) {
    const ChainNode<T>& from = w.nodes[k];
    const ChainState<T>& before = w.state[k];
    const NodeRates<T> past = PartOfPast(c, before);
    const NodeRates<T> algorithm = {algorithm_by_rate * (from.rate.v - past.v),
                                    algorithm_by_rate * (from.rate.omega - past.omega)};
    const NodeRates<T> mean = {old_mean * before.algorithm.v + new_mean * algorithm.v,
                               old_mean * before.algorithm.omega + new_mean * algorithm.omega};
    if (k >= w.layout.padding) {
      foretold.Add(before.mean.v, mean.v);
      foretold_omega.Add(before.mean.omega, mean.omega);
    }
    ChainState<T> now = {from.at, from.rate, algorithm, mean};
    now.at.q = Renormalised(now.at.q);
    w.state[k] = all ? now : Taken(taken, now, before);
  }
  w.persistence = {Taken(taken, foretold.Part(), w.persistence.v),
                   Taken(taken, foretold_omega.Part(), w.persistence.omega)};
}

/// False where it has to be done again, as EliminateForward.
template <bool kJointed, class T>
bool EvaluateStrainsOf(StepChain<T>* chain) {
  StepChain<T>& w = *chain;
  const ScaledLaw<T> slack(w.law);
  T largest(0.0);
  for (int e = 0; e < w.layout.chain_elements; ++e)
    w.strains[e] = StrainOf(StateOf<kJointed>(w, w.state, e, LawOf(w, slack, e).bowing, &largest));
  if (w.careful || !AnyAtLeast(largest, kArcTangentSeriesBelow)) return true;
  w.careful = true;
  return false;
}

}  // namespace

// Joints are rare: with them, the loops are compiled once, for the oldest machine.
#define COSSERAT_CABLE_DEFINE_CHAIN_ADVANCE(KERNEL, T)                               \
  KERNEL                                                                             \
  void Predict(const StepCoefficients& c, StepChain<T>* w) { PredictOf(c, w); }      \
  KERNEL                                                                             \
  void AcceptUnjointed(const StepCoefficients& c, const T& taken, StepChain<T>* w) { \
    while (!CommitElements<false>(c, taken, w)) continue;                            \
    CommitNodes(c, taken, w);                                                        \
  }                                                                                  \
  void Accept(const StepCoefficients& c, const T& taken, StepChain<T>* w) {          \
    if (w->joints.empty()) return AcceptUnjointed(c, taken, w);                      \
    while (!CommitElements<true>(c, taken, w)) continue;                             \
    CommitNodes(c, taken, w);                                                        \
  }                                                                                  \
  KERNEL                                                                             \
  void EvaluateStrainsUnjointed(StepChain<T>* w) {                                   \
    while (!EvaluateStrainsOf<false>(w)) continue;                                   \
  }                                                                                  \
  void EvaluateStrains(StepChain<T>* w) {                                            \
    if (w->joints.empty()) return EvaluateStrainsUnjointed(w);                       \
    while (!EvaluateStrainsOf<true>(w)) continue;                                    \
  }

COSSERAT_CABLE_DEFINE_CHAIN_ADVANCE(COSSERAT_CABLE_KERNEL, WideLanes)
COSSERAT_CABLE_DEFINE_CHAIN_ADVANCE(COSSERAT_CABLE_KERNEL, Lanes)
COSSERAT_CABLE_DEFINE_CHAIN_ADVANCE(COSSERAT_CABLE_KERNEL, LanePair)

}  // namespace cosserat_cable::rod
