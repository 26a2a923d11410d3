// A rod in a chain: what the solver of a step is told of it, and what it takes over.
#include <algorithm>

#include "lane_access.h"
#include "rod_impl.h"

namespace cosserat_cable::rod {

void Rod::Impl::BeginStep(const StepCoefficients& c, const Pose& a, const Pose& b) {
  if (!energy.open()) energy.Open({EndPower(), 0, 0}, StoredEnergy());
  next_law_ = LawOfStep(c.dt);
  for (int e = 0; e < model.elements; ++e) next_offsets_[e] = Offset(next_law_, e);
  ends_before_ = ends;
  ends.a.MoveTo(a, c);
  ends.b.MoveTo(b, c);
}

template <class T>
void Rod::Impl::FillChain(int rod_lane, StepChain<T>* chain) const {
  const ChainLayout& layout = chain->layout;
  const int end = layout.chain_elements;
  for (int lane = 0; lane < kLaneCount<T>; ++lane) {
    if (!layout.halves && lane != rod_lane) continue;
    const bool backwards = layout.halves && lane == 1;
    SetLane(&chain->gravity, lane, w.gravity);
    SetLane(&chain->law, lane, next_law_);
    if (backwards) SetLane(&chain->law.gamma0, lane, -next_law_.gamma0);
    for (int k = 0; k <= end; ++k) {
      const int i = std::max(0, layout.NodeAt(k, lane));
      const double share = layout.halves && k == end ? 0.5 : 1.0;  // both halves have the middle
      SetLane(&chain->nodes[k].mass, lane, share * w.mass[i]);
      SetLane(&chain->nodes[k].inertia, lane, share * w.inertia[i]);
    }
    for (int k = 0; k < end; ++k) {
      const ElementOffset<double>& offset = next_offsets_[std::max(0, layout.ElementAt(k, lane))];
      SetLane(&chain->offsets[k].F, lane, backwards ? -offset.F : offset.F);
      SetLane(&chain->offsets[k].M, lane, backwards ? -offset.M : offset.M);
    }
  }
}

template <class T>
void Rod::Impl::HoldInChain(int rod_lane, StepChain<T>* chain) const {
  const ChainLayout& layout = chain->layout;
  const auto hold = [&](const ChainLayout::Place& at, const NodeState& node,
                        const NodeRates<double>& rate) {
    ChainNode<T>& to = chain->nodes[at.entry];
    SetLane(&to.at, at.lane, node);
    SetLane(&to.rate, at.lane, rate);
    SetLane(&to.q0, at.lane, node.q);
    SetLane(&to.turn, at.lane, V3{});
  };
  const auto clamped = [](const EndPart& end, const NodeState& before) {
    NodeState node = before;
    end.ImposePose(&node);  // on that side of q and -q from which the neighbours were reached
    node.v = ToSmall(end.clamp().v);
    node.omega = ToSmall(end.clamp().omega);
    return node;
  };
  const auto hold_clamped = [&](const EndPart& end, int i) {
    hold(layout.OfNode(i, rod_lane), clamped(end, w.node[i]),
         {ToSmall(end.clamp().a), ToSmall(end.clamp().alpha)});
  };
  if (model.a.clamped()) hold_clamped(ends.a, 0);
  if (model.b.clamped()) hold_clamped(ends.b, model.elements);
  if (layout.padding > 0) {  // the node that is nowhere: one element straight ahead of the first
    NodeState before = model.a.clamped() ? clamped(ends.a, w.node.front()) : w.node.front();
    before.r -= ToMatrix(before.q) * V3{0, 0, h};
    const ChainLayout::Place front = layout.OfNode(0, rod_lane);
    hold({front.entry - 1, front.lane}, before, {});
  }
}

template <class T>
void Rod::Impl::TakeStep(const StepChain<T>& chain, int rod_lane) {
  const ChainLayout& layout = chain.layout;
  const ChainLayout::Place front = layout.OfNode(0, rod_lane);
  const ChainLayout::Place back = layout.OfNode(model.elements, rod_lane);
  missing_a = GetLane(chain.missing_first[front.entry], front.lane);
  missing_b = GetLane(layout.halves ? chain.missing_first[0] : chain.missing_last, back.lane);
  if (chain.loaded)
    for (int k = 0; k < 6; ++k) {
      missing_a[k] += GetLane(chain.load_rhs[front.entry][k], front.lane);
      missing_b[k] += GetLane(chain.load_rhs[back.entry][k], back.lane);
    }
  dissipation_rate_ = 0;
  for (int e = 0; e < model.elements; ++e) {
    const ChainLayout::Place at = layout.OfElement(e, rod_lane);
    const ChainStrain<T>& found = chain.strains[at.entry];
    const double per_length = layout.halves && at.lane == 1 ? -1 / h : 1 / h;
    const auto strain_of = [&](const Vec3<T>& change) {
      return ToEigen(per_length * GetLane(change, at.lane));
    };
    const ElementStrain strain = {
        strain_of(found.u) - model.section.gamma0, strain_of(found.u_rate),
        strain_of(found.theta) - model.section.kappa0, strain_of(found.theta_rate)};
    shear[e] = {shear1.Commit(shear[e][0], strain.gamma.x(), strain.gamma_dot.x()),
                shear2.Commit(shear[e][1], strain.gamma.y(), strain.gamma_dot.y())};
    branches.Commit(e, strain);
    dissipation_rate_ += h * DissipationRate(e, strain);
  }
  law = next_law_;
  std::swap(offsets, next_offsets_);
  stress_known_ = false;
}

template void Rod::Impl::FillChain(int, StepChain<Lanes>*) const;
template void Rod::Impl::FillChain(int, StepChain<LanePair>*) const;
template void Rod::Impl::HoldInChain(int, StepChain<Lanes>*) const;
template void Rod::Impl::HoldInChain(int, StepChain<LanePair>*) const;
template void Rod::Impl::TakeStep(const StepChain<Lanes>&, int);
template void Rod::Impl::TakeStep(const StepChain<LanePair>&, int);

}  // namespace cosserat_cable::rod
