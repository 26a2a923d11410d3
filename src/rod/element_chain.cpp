#include "element_chain.h"

#include <algorithm>

#include "kernel.h"

namespace cosserat_cable::rod {
namespace {

constexpr int kLanes = Lanes::kCount;

Vec3<Lanes> Broadcast(const Vec3<double>& v) { return {v.x, v.y, v.z}; }

ElementLaw<Lanes> Broadcast(const ElementLaw<double>& law) {
  return {law.h,
          Broadcast(law.C_F),
          Broadcast(law.C_M),
          Broadcast(law.V_F),
          Broadcast(law.V_M),
          Broadcast(law.gamma0),
          Broadcast(law.kappa0)};
}

/// Four nodes side by side.
Node<Lanes> Gather(const Node<double>& a, const Node<double>& b, const Node<double>& c,
                   const Node<double>& d) {
  const auto vec = [&](Vec3<double> Node<double>::*m) {
    return Vec3<Lanes>{{(a.*m).x, (b.*m).x, (c.*m).x, (d.*m).x},
                       {(a.*m).y, (b.*m).y, (c.*m).y, (d.*m).y},
                       {(a.*m).z, (b.*m).z, (c.*m).z, (d.*m).z}};
  };
  Node<Lanes> n;
  n.r = vec(&Node<double>::r);
  n.v = vec(&Node<double>::v);
  n.omega = vec(&Node<double>::omega);
  n.q = {{a.q.w, b.q.w, c.q.w, d.q.w},
         {a.q.x, b.q.x, c.q.x, d.q.x},
         {a.q.y, b.q.y, c.q.y, d.q.y},
         {a.q.z, b.q.z, c.q.z, d.q.z}};
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

}  // namespace

ElementChain::ElementChain(int elements)
    : elements_(elements),
      states_((elements + kLanes - 1) / kLanes),
      offsets_(states_.size(), Vec3<Lanes>{0.0, 0.0, 0.0}) {}

void ElementChain::SetOffset(int element, const Vec3<double>& offset_F) {
  Vec3<Lanes>& group = offsets_[element / kLanes];
  const int lane = element % kLanes;
  group.x.v[lane] = offset_F.x;
  group.y.v[lane] = offset_F.y;
  group.z.v[lane] = offset_F.z;
}

void ElementChain::ClearOffsets() {
  std::fill(offsets_.begin(), offsets_.end(), Vec3<Lanes>{0.0, 0.0, 0.0});
}

COSSERAT_CABLE_KERNEL
void ElementChain::Evaluate(const Node<double>* nodes, const ElementLaw<double>& law,
                            Vec6<double>* rhs) {
  const ElementLaw<Lanes> wide = Broadcast(law);
  for (int first = 0; first < elements_; first += kLanes) {
    // The lanes left over at the end repeat the last element.
    const auto at = [&](int lane) { return nodes + std::min(first + lane, elements_ - 1); };
    const Node<double>*n0 = at(0), *n1 = at(1), *n2 = at(2), *n3 = at(3);
    ElementState<Lanes>& state = states_[first / kLanes];
    EvaluateStrain(Gather(*n0, *n1, *n2, *n3), Gather(n0[1], n1[1], n2[1], n3[1]), wide.h, &state);
    EvaluateStress(wide, offsets_[first / kLanes], &state);
    const ElementForces<Lanes> forces = EvaluateForces(state);
    const int lanes = std::min(kLanes, elements_ - first);
    for (int lane = 0; lane < lanes; ++lane) {
      Vec6<double>&a = rhs[first + lane], &b = rhs[first + lane + 1];
      a[0] += forces.f.x[lane];
      a[1] += forces.f.y[lane];
      a[2] += forces.f.z[lane];
      b[0] -= forces.f.x[lane];
      b[1] -= forces.f.y[lane];
      b[2] -= forces.f.z[lane];
      a[3] -= forces.g1.x[lane];
      a[4] -= forces.g1.y[lane];
      a[5] -= forces.g1.z[lane];
      b[3] -= forces.g2.x[lane];
      b[4] -= forces.g2.y[lane];
      b[5] -= forces.g2.z[lane];
    }
  }
}

COSSERAT_CABLE_KERNEL
void ElementChain::AssembleTangent(double h, const Vec3<double>& C_F, const Vec3<double>& C_M,
                                   BlockTridiagonal<double>* system) const {
  const Vec3<Lanes> wide_F = Broadcast(C_F), wide_M = Broadcast(C_M);
  const Lanes wide_h = h;
  // Only lower triangles of the diagonal blocks are read: quarter (0, 1) is never filled. An
  // element sets the block of its second node and adds to that of its first.
  Block6<double>& front = system->diagonal(0);
  front.SetQuarter(0, 0, {});
  front.SetQuarter(1, 0, {});
  front.SetQuarter(1, 1, {});
  for (int first = 0; first < elements_; first += kLanes) {
    ElementTangent<Lanes> k = EvaluateTangent(states_[first / kLanes], wide_h, wide_F, wide_M);
    const int lanes = std::min(kLanes, elements_ - first);
    for (int lane = 0; lane < lanes; ++lane) {
      const int e = first + lane;
      const Mat3<double> rr = Lane(k.rr, lane), r1 = Lane(k.r1, lane);
      const Mat3<double> r2_transposed = Transpose(Lane(k.r2, lane));
      Block6<double>& a = system->diagonal(e);
      a.AddQuarter(0, 0, rr);
      a.AddQuarter(1, 0, -Transpose(r1));
      a.AddQuarter(1, 1, Lane(k.t11, lane));
      Block6<double>& b = system->diagonal(e + 1);
      b.SetQuarter(0, 0, rr);
      b.SetQuarter(1, 0, r2_transposed);
      b.SetQuarter(1, 1, Lane(k.t22, lane));
      Block6<double>& c = system->lower(e);
      c.SetQuarter(0, 0, -rr);
      c.SetQuarter(0, 1, r1);
      c.SetQuarter(1, 0, -r2_transposed);
      c.SetQuarter(1, 1, Transpose(Lane(k.t12, lane)));
    }
  }
}

}  // namespace cosserat_cable::rod
