#include "element_chain.h"

#include <algorithm>

#include "cosserat_cable/math/kernel.h"
#include "lane_access.h"

namespace cosserat_cable::rod {
namespace {

constexpr int kLanes = Lanes::kCount;

ElementLaw<Lanes> Broadcast(const ElementLaw<double>& law) {
  ElementLaw<Lanes> wide;
  for (int l = 0; l < kLanes; ++l) SetLane(&wide, l, law);
  return wide;
}

/// Four nodes side by side.
Node<Lanes> Gather(const Node<double>& a, const Node<double>& b, const Node<double>& c,
                   const Node<double>& d) {
  const auto four = [&](double x, double y, double z, double w) {
    return Lanes::Of(Lanes::Vector{x, y, z, w});
  };
  const auto vec = [&](Vec3<double> Node<double>::*m) {
    return Vec3<Lanes>{four((a.*m).x, (b.*m).x, (c.*m).x, (d.*m).x),
                       four((a.*m).y, (b.*m).y, (c.*m).y, (d.*m).y),
                       four((a.*m).z, (b.*m).z, (c.*m).z, (d.*m).z)};
  };
  Node<Lanes> n;
  n.r = vec(&Node<double>::r);
  n.v = vec(&Node<double>::v);
  n.omega = vec(&Node<double>::omega);
  n.q = {four(a.q.w, b.q.w, c.q.w, d.q.w), four(a.q.x, b.q.x, c.q.x, d.q.x),
         four(a.q.y, b.q.y, c.q.y, d.q.y), four(a.q.z, b.q.z, c.q.z, d.q.z)};
  return n;
}

Mat3<double> Lane(const Mat3<Lanes>& a, int lane) {
  Mat3<double> out;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) out[i][j] = a[i][j][lane];
  return out;
}

Vec3<double> Lane(const Vec3<Lanes>& v, int lane) { return {v.x[lane], v.y[lane], v.z[lane]}; }

template <class T>
void AddForces(const ElementForces<T>& forces, Vec6<T>* a, Vec6<T>* b) {
  (*a)[0] += forces.f.x;
  (*a)[1] += forces.f.y;
  (*a)[2] += forces.f.z;
  (*b)[0] -= forces.f.x;
  (*b)[1] -= forces.f.y;
  (*b)[2] -= forces.f.z;
  (*a)[3] -= forces.g1.x;
  (*a)[4] -= forces.g1.y;
  (*a)[5] -= forces.g1.z;
  (*b)[3] -= forces.g2.x;
  (*b)[4] -= forces.g2.y;
  (*b)[5] -= forces.g2.z;
}

// Only lower triangles of the diagonal blocks are read: quarter (0, 1) is never filled. An element
// sets the block of its second node and adds to that of its first.
template <class T>
void ClearFront(BlockTridiagonal<T>* system) {
  Block6<T>& front = system->diagonal(0);
  const T zero(0.0);
  const Vec3<T> none{zero, zero, zero};
  const Mat3<T> nothing = Outer(none, none);
  front.SetQuarter(0, 0, nothing);
  front.SetQuarter(1, 0, nothing);
  front.SetQuarter(1, 1, nothing);
}

template <class T>
void AddTangent(const ElementTangent<T>& k, int e, BlockTridiagonal<T>* system) {
  const Mat3<T> r2_transposed = Transpose(k.r2);
  Block6<T>& a = system->diagonal(e);
  a.AddQuarter(0, 0, k.rr);
  a.AddQuarter(1, 0, -Transpose(k.r1));
  a.AddQuarter(1, 1, k.t11);
  Block6<T>& b = system->diagonal(e + 1);
  b.SetQuarter(0, 0, k.rr);
  b.SetQuarter(1, 0, r2_transposed);
  b.SetQuarter(1, 1, k.t22);
  Block6<T>& c = system->lower(e);
  c.SetQuarter(0, 0, -k.rr);
  c.SetQuarter(0, 1, k.r1);
  c.SetQuarter(1, 0, -r2_transposed);
  c.SetQuarter(1, 1, Transpose(k.t12));
}

constexpr int Entries(int elements, double*) { return (elements + kLanes - 1) / kLanes; }
constexpr int Entries(int elements, Lanes*) { return elements; }

}  // namespace

template <class T>
ElementChain<T>::ElementChain(int elements)
    : elements_(elements), states_(Entries(elements, static_cast<T*>(nullptr))) {
  const Vec3<Lanes> none{0.0, 0.0, 0.0};
  offsets_.assign(states_.size(), {none, none});
  stiffening_.resize(states_.size());
  for (int e = 0; e < elements_; ++e)
    for (int l = 0; l < kLanes; ++l) SetStiffening(e, l, {});
  laws_.resize(states_.size());
}

template <class T>
void ElementChain<T>::SetOffset(int element, int lane, const Vec3<double>& offset_F,
                                const Vec3<double>& offset_M) {
  const bool one = kLaneCount<T> == 1;
  ElementOffset<Lanes>& entry = offsets_[one ? element / kLanes : element];
  const int l = one ? element % kLanes : lane;
  SetLane(&entry.F.x, l, offset_F.x);
  SetLane(&entry.F.y, l, offset_F.y);
  SetLane(&entry.F.z, l, offset_F.z);
  SetLane(&entry.M.x, l, offset_M.x);
  SetLane(&entry.M.y, l, offset_M.y);
  SetLane(&entry.M.z, l, offset_M.z);
}

template <class T>
void ElementChain<T>::SetStiffening(int element, int lane, const Stiffening<double>& by) {
  const bool one = kLaneCount<T> == 1;
  SetLane(&stiffening_[one ? element / kLanes : element], one ? element % kLanes : lane, by);
}

template <class T>
ElementStress ElementChain<T>::Stress(int element, int lane) const {
  const bool one = kLaneCount<T> == 1;
  const int entry = one ? element / kLanes : element, l = one ? element % kLanes : lane;
  const ElementState<Lanes>& e = states_[entry];
  const double one_over_h = laws_[entry].one_over_h[l];
  return {one_over_h * Lane(e.u, l),
          one_over_h * Lane(e.u_rate, l),
          one_over_h * Lane(e.theta, l),
          one_over_h * Lane(e.theta_rate, l),
          Lane(e.n, l),
          Lane(e.m, l)};
}

template <class T>
Bowing<double> ElementChain<T>::BowingOf(int element, int lane) const {
  const bool one = kLaneCount<T> == 1;
  return GetLane(laws_[one ? element / kLanes : element].bowing, one ? element % kLanes : lane);
}

template <>
COSSERAT_CABLE_KERNEL void ElementChain<double>::Evaluate(const Node<double>* nodes,
                                                          const ElementLaw<double>& law,
                                                          Vec6<double>* rhs) {
  const ScaledLaw<Lanes> slack(Broadcast(law));
  const Node<double>* lefts = nodes;
  if (!joints_.empty()) {
    seen_.resize(elements_);
    for (int e = 0; e < elements_; ++e) seen_[e] = SeenThrough(joints_[e].first, nodes[e]);
    lefts = seen_.data();
  }
  for (int first = 0; first < elements_; first += kLanes) {
    // The lanes left over at the end repeat the last element.
    const auto at = [&](const Node<double>* from, int lane) -> const Node<double>& {
      return from[std::min(first + lane, elements_ - 1)];
    };
    const auto gather = [&](const Node<double>* from) {
      return Gather(at(from, 0), at(from, 1), at(from, 2), at(from, 3));
    };
    ElementState<Lanes>& state = states_[first / kLanes];
    ScaledLaw<Lanes>& own = laws_[first / kLanes];
    own = ScaledLaw<Lanes>(slack, stiffening_[first / kLanes], Lanes(1.0));
    EvaluateStrain(gather(lefts), gather(nodes + 1), own.bowing, &state);
    EvaluateStress(own, offsets_[first / kLanes], &state);
    const ElementForces<Lanes> forces = EvaluateForces(state, own.bowing);
    const int lanes = std::min(kLanes, elements_ - first);
    for (int l = 0; l < lanes; ++l) {
      ElementForces<double> one = {Lane(forces.f, l), Lane(forces.g1, l), Lane(forces.g2, l)};
      if (!joints_.empty()) TurnBack(joints_[first + l], &one);
      AddForces(one, &rhs[first + l], &rhs[first + l + 1]);
    }
  }
}

template <>
COSSERAT_CABLE_KERNEL void ElementChain<double>::AssembleTangent(
    double rate_factor, BlockTridiagonal<double>* system) const {
  const Lanes by_rate(rate_factor);
  ClearFront(system);
  for (int first = 0; first < elements_; first += kLanes) {
    const ScaledLaw<Lanes>& own = laws_[first / kLanes];
    const TangentLaw<Lanes> law{own.bowing, own.C_F + by_rate * own.V_F,
                                own.C_M + by_rate * own.V_M};
    const ElementTangent<Lanes> k = EvaluateTangent(states_[first / kLanes], law);
    const int lanes = std::min(kLanes, elements_ - first);
    for (int l = 0; l < lanes; ++l) {
      ElementTangent<double> one = {Lane(k.rr, l),  Lane(k.r1, l),  Lane(k.r2, l),
                                    Lane(k.t11, l), Lane(k.t12, l), Lane(k.t22, l)};
      if (!joints_.empty()) TurnBack(joints_[first + l], &one);
      AddTangent(one, first + l, system);
    }
  }
}

template class ElementChain<double>;

}  // namespace cosserat_cable::rod
