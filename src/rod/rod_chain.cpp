// A rod in a chain: what the solver of a step is told of it, and what it takes over.
#include <algorithm>

#include "lane_access.h"
#include "rod_impl.h"

namespace cosserat_cable::rod {

void Rod::Impl::BeginStep(const StepCoefficients& c, const Pose& a, const Pose& b) {
  if (!energy.open()) energy.Open({EndPower(), 0, 0}, StoredEnergy());
  next_law_ = LawOfStep(c.dt);
  ends_before_ = ends;
  ends.a.MoveTo(a, c);
  ends.b.MoveTo(b, c);
}

template <class T>
void Rod::Impl::FillMasses(int rod_lane, const ChainLayout& layout,
                           std::vector<NodeMass<T>>* masses) const {
  const int end = layout.chain_elements;
  for (int lane = 0; lane < kLaneCount<T>; ++lane) {
    if (!layout.halves && lane != rod_lane) continue;
    for (int k = 0; k <= end; ++k) {
      const int i = std::max(0, layout.NodeAt(k, lane));
      const double share = layout.halves && k == end ? 0.5 : 1.0;  // both halves have the middle
      SetLane(&(*masses)[k].mass, lane, share * w.mass[i]);
      SetLane(&(*masses)[k].inertia, lane, share * w.inertia[i]);
    }
  }
}

template <class T>
void Rod::Impl::FillChain(int rod_lane, StepChain<T>* chain, ShearLanes<T>* shear_lanes) {
  const ChainLayout& layout = chain->layout;
  const ShearStep<double> steps[] = {shear1.step(), shear2.step()};
  const V3 unbend = -Scale(next_law_.C_M, ToSmall(model.section.kappa0));
  for (int lane = 0; lane < kLaneCount<T>; ++lane) {
    if (!layout.halves && lane != rod_lane) continue;
    const bool backwards = layout.halves && lane == 1;
    SetLane(&chain->gravity, lane, w.gravity);
    SetLane(&chain->law, lane, next_law_);
    if (backwards) SetLane(&chain->law.gamma0, lane, -next_law_.gamma0);
    for (int k = 0; k < 2; ++k) SetLane(&shear_lanes->axis[k], lane, steps[k]);
    SetLane(&shear_lanes->unbend, lane, unbend);
    SetLane(&shear_lanes->gamma0, lane, next_law_.gamma0);
    SetLane(&shear_lanes->per_length, lane, (backwards ? -1 : 1) / h);
    SetLane(&shear_lanes->forwards, lane, backwards ? -1.0 : 1.0);
    shear_lanes->history[lane] = shear.data();
    shear_lanes->offsets[lane] = next_offsets_.data();
    if (!joints.empty()) FillJoints(lane, chain);
  }
}

template <class T>
void Rod::Impl::AddBranches(int rod_lane, StepChain<T>* chain) {
  if (branches.empty()) return;
  const ChainLayout& layout = chain->layout;
  const V3 unbend = -Scale(next_law_.C_M, ToSmall(model.section.kappa0));
  for (int e = 0; e < model.elements; ++e) {
    const SectionValue more = branches.Offset(e);
    ElementOffset<double>& offset = next_offsets_[e];
    offset.F += ToSmall(more.F);
    offset.F.z = more.F.z();
    offset.M = unbend + ToSmall(more.M);
  }
  for (int lane = 0; lane < kLaneCount<T>; ++lane) {
    if (!layout.halves && lane != rod_lane) continue;
    const bool backwards = layout.halves && lane == 1;
    for (int k = 0; k < layout.chain_elements; ++k) {
      const ElementOffset<double>& offset = next_offsets_[std::max(0, layout.ElementAt(k, lane))];
      SetLane(&chain->offsets[k].F, lane, backwards ? -offset.F : offset.F);
      SetLane(&chain->offsets[k].M, lane, backwards ? -offset.M : offset.M);
    }
  }
}

template <class T>
void Rod::Impl::FillJoints(int lane, StepChain<T>* chain) const {
  const ChainLayout& layout = chain->layout;
  const Quat<double> straight{1, 0, 0, 0};
  const bool backwards = layout.halves && lane == 1;
  for (int k = 0; k < layout.chain_elements; ++k) {
    const int e = layout.ElementAt(k, lane);  // the joint of its first node is before it
    const Quat<double> turn = e < 0 ? straight : joints[e];
    SetLane(&chain->joints[k].first, lane, backwards ? straight : turn);
    SetLane(&chain->joints[k].second, lane, backwards ? turn : straight);
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
double Rod::Impl::CommitBranches(const StepChain<T>& chain, int lane, double per_length) {
  double rate = 0;
  const int padding = lane == 0 ? chain.layout.padding : 0;
  for (int k = padding; k < chain.layout.chain_elements; ++k) {
    const auto strain_of = [&](const Vec3<T>& change) -> Eigen::Vector3d {
      return ToEigen(per_length * GetLane(change, lane));
    };
    const ChainStrain<T>& found = chain.strains[k];
    const int e = chain.layout.ElementAt(k, lane);
    branches.Commit(e,
                    {strain_of(found.u) - model.section.gamma0, strain_of(found.u_rate),
                     strain_of(found.theta) - model.section.kappa0, strain_of(found.theta_rate)});
    rate += branches.DissipationRate(e);
  }
  return rate;
}

template <class T>
void Rod::Impl::TakeStep(const StepChain<T>& chain, const ShearLanes<T>& shear_lanes,
                         int rod_lane) {
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
  double dissipation = 0;
  for (int lane = 0; lane < kLaneCount<T>; ++lane) {
    if (!layout.halves && lane != rod_lane) continue;
    dissipation += GetLane(chain.dissipation, lane) + h * GetLane(shear_lanes.dissipation, lane);
    if (!branches.empty())
      dissipation += h * CommitBranches(chain, lane, GetLane(shear_lanes.per_length, lane));
  }
  dissipation_rate_ = dissipation;
  law = next_law_;
  std::swap(offsets, next_offsets_);
  stress_known_ = false;
}

#define COSSERAT_CABLE_INSTANTIATE(T)                                                            \
  template void Rod::Impl::FillMasses(int, const ChainLayout&, std::vector<NodeMass<T>>*) const; \
  template void Rod::Impl::FillChain(int, StepChain<T>*, ShearLanes<T>*);                        \
  template void Rod::Impl::AddBranches(int, StepChain<T>*);                                      \
  template void Rod::Impl::HoldInChain(int, StepChain<T>*) const;                                \
  template void Rod::Impl::TakeStep(const StepChain<T>&, const ShearLanes<T>&, int);
COSSERAT_CABLE_INSTANTIATE(WideLanes)
COSSERAT_CABLE_INSTANTIATE(Lanes)
COSSERAT_CABLE_INSTANTIATE(LanePair)
#undef COSSERAT_CABLE_INSTANTIATE

}  // namespace cosserat_cable::rod
