// A rod in a chain: what the solver of a step is told of it, and what it takes over.
#include <algorithm>

#include "lane_access.h"
#include "rod_impl.h"

namespace cosserat_cable::rod {
namespace {

/// Seen from the other end.
Bowing<double> Backwards(const Bowing<double>& b) {
  return {b.along_normal, -b.along_chord, -b.twist, -b.bend_x, -b.bend_y};
}
BeamColumn<double> Backwards(const BeamColumn<double>& column) {
  return {column.x, column.y, -column.bend, -column.shear};
}

}  // namespace

void Rod::Impl::BeginStep(const StepCoefficients& c, const Pose& a, const Pose& b) {
  BeginHistory();
  if (!energy.open()) {
    Fetch();
    energy.Open({EndPower(), 0, 0, 0}, StoredEnergy());
  }
  if (c.dt != dt_of_law_ || !branches.empty()) law_of_step_ = LawOfStep(c.dt);
  laws.BeginStep(c.dt);
  dt_of_law_ = c.dt;
  a_before_ = ends.a.prescribed();
  b_before_ = ends.b.prescribed();
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
void Rod::Impl::FillLaw(int rod_lane, StepChain<T>* chain, double* dt_there) const {
  if (*dt_there == dt_of_law_ && branches.empty()) return;
  *dt_there = dt_of_law_;
  const ChainLayout& layout = chain->layout;
  const ShearStep<double> step1 = shear1.step(), step2 = shear2.step();
  const V3 unbend = -Scale(law_of_step_.C_M, ToSmall(model.section.kappa0));
  for (int lane = 0; lane < kLaneCount<T>; ++lane) {
    if (!layout.halves && lane != rod_lane) continue;
    const double forwards = layout.halves && lane == 1 ? -1.0 : 1.0;
    SetLane(&chain->gravity, lane, w.gravity);
    SetLane(&chain->law, lane, law_of_step_);
    SetLane(&chain->law.gamma0, lane, forwards * law_of_step_.gamma0);
    if (forwards < 0) {
      SetLane(&chain->law.bowing, lane, Backwards(law_of_step_.bowing));
      SetLane(&chain->law.column, lane, Backwards(law_of_step_.column));
    }
    SetLane(&chain->unbend, lane, forwards * unbend);
    ChainShearLaw<T>& shear_law = chain->shear_law;
    SetLane(&shear_law.x, lane, step1);
    SetLane(&shear_law.y, lane, step2);
    SetLane(&shear_law.gamma0, lane, law_of_step_.gamma0);
    SetLane(&shear_law.per_length, lane, forwards / h);
    SetLane(&shear_law.forwards, lane, forwards);
    if (!joints.empty()) FillJoints(lane, chain);
  }
}

LawsOfRod Rod::Impl::LawsOfStep() const {
  return {laws.empty() ? nullptr : &laws, &branches, model.section.gamma0, model.section.kappa0};
}

template <class T>
void Rod::Impl::FillBranches(int rod_lane, StepChain<T>* chain) const {
  const ChainLayout& layout = chain->layout;
  for (int lane = 0; lane < kLaneCount<T>; ++lane) {
    if (!layout.halves && lane != rod_lane) continue;
    const double forwards = layout.halves && lane == 1 ? -1.0 : 1.0;
    for (int k = 0; k < layout.chain_elements; ++k) {
      // Nothing of a rod without branches: what was there may be of another one.
      const SectionValue more = branches.Offset(std::max(0, layout.ElementAt(k, lane)));
      SetLane(&chain->branch_offsets[k].F, lane, forwards * ToSmall(more.F));
      SetLane(&chain->branch_offsets[k].M, lane, forwards * ToSmall(more.M));
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
ElementStress Rod::Impl::StressIn(const StepChain<T>& chain, int entry, int lane,
                                  int element) const {
  const double per_length = GetLane(chain.shear_law.per_length, lane);
  const ChainStrain<T>& strain = chain.strains[entry];
  ElementStress found;
  found.gamma = per_length * GetLane(strain.u, lane);
  found.gamma_dot = per_length * GetLane(strain.u_rate, lane);
  found.kappa = per_length * GetLane(strain.theta, lane);
  found.kappa_dot = per_length * GetLane(strain.theta_rate, lane);
  const Section& s = model.section;
  const ElementStrain beyond = StrainOf(found);
  const Eigen::Vector3d m = s.C_M.cwiseProduct(beyond.kappa) + s.V_M.cwiseProduct(beyond.kappa_dot);
  found.n = {shear1.Force(shear[element][0]), shear2.Force(shear[element][1]),
             s.C_F.z() * beyond.gamma.z() + s.V_F.z() * beyond.gamma_dot.z()};
  found.m = ToSmall(m);
  const Stiffening<double>& by = stiffening[element];
  found.n += {by.y.C_F * found.gamma.x + by.y.V_F * found.gamma_dot.x,
              by.x.C_F * found.gamma.y + by.x.V_F * found.gamma_dot.y, 0};
  found.m += {by.x.C_M * found.kappa.x + by.x.V_M * found.kappa_dot.x,
              by.y.C_M * found.kappa.y + by.y.V_M * found.kappa_dot.y, 0};
  return found;
}

template <class T>
void Rod::Impl::TakeState(const StepChain<T>& chain, int rod_lane) {
  const ChainLayout& layout = chain.layout;
  w.persistence = GetLane(chain.persistence, rod_lane);
  for (int i = 0; i <= model.elements; ++i) {
    const ChainLayout::Place at = layout.OfNode(i, rod_lane);
    const ChainState<T>& state = chain.state[at.entry];
    w.node[i] = GetLane(state.at, at.lane);
    w.rate[i] = GetLane(state.rate, at.lane);
    w.algorithm[i] = GetLane(state.algorithm, at.lane);
    w.mean[i] = GetLane(state.mean, at.lane);
  }
  for (int e = 0; e < model.elements; ++e) {
    const ChainLayout::Place at = layout.OfElement(e, rod_lane);
    shear[e] = GetLane(chain.shear[at.entry], at.lane);
    tension[e] = GetLane(chain.tension[at.entry], at.lane);
    stiffening[e] =
        chain.taut ? GetLane(chain.stiffening[at.entry], at.lane) : Stiffening<double>{};
    stress_[e] = StressIn(chain, at.entry, at.lane, e);
    if (!has_branch_stress()) continue;
    stress_[e].n += ToSmall(branch_stress_[e].F);
    stress_[e].m += ToSmall(branch_stress_[e].M);
  }
}

template <class T>
double Rod::Impl::CommitBranches(const StepChain<T>& chain, int rod_lane) {
  const SectionValue stiffness = branches.StepStiffness();
  double rate = 0;
  for (int e = 0; e < model.elements; ++e) {
    const ChainLayout::Place at = chain.layout.OfElement(e, rod_lane);
    const double per_length = GetLane(chain.shear_law.per_length, at.lane);
    const ChainStrain<T>& found = chain.strains[at.entry];
    const auto strain_of = [&](const Vec3<T>& change) -> Eigen::Vector3d {
      return ToEigen(per_length * GetLane(change, at.lane));
    };
    const ElementStrain strain = {
        strain_of(found.u) - model.section.gamma0, strain_of(found.u_rate),
        strain_of(found.theta) - model.section.kappa0, strain_of(found.theta_rate)};
    branch_stress_[e] = branches.Offset(e);
    branch_stress_[e].F += stiffness.F.cwiseProduct(strain.gamma);
    branch_stress_[e].M += stiffness.M.cwiseProduct(strain.kappa);
    if (!laws.empty()) {
      branch_stress_[e] += Split(laws.Evaluate(e, strain, 0).stress);
      lost_in_step_ += h * laws.Commit(e, strain);
    }
    branches.Commit(e, strain);
    rate += branches.DissipationRate(e);
  }
  return rate;
}

template <class T>
void Rod::Impl::TakeStep(const StepChain<T>& chain, int rod_lane, double dt) {
  const ChainLayout& layout = chain.layout;
  const ChainLayout::Place front = layout.OfNode(0, rod_lane);
  const ChainLayout::Place back = layout.OfNode(model.elements, rod_lane);
  w.node.front() = GetLane(chain.state[front.entry].at, front.lane);
  w.node.back() = GetLane(chain.state[back.entry].at, back.lane);
  w.time += dt;
  lost_in_ends_ = ends.a.CommitLaws(w.node.front(), EndPart::Memory::kKept) +
                  ends.b.CommitLaws(w.node.back(), EndPart::Memory::kKept);
  missing_a = GetLane(chain.missing_first[front.entry], front.lane);
  missing_b = GetLane(layout.halves ? chain.missing_first[0] : chain.missing_last, back.lane);
  if (chain.loaded)
    for (int k = 0; k < 6; ++k) {
      missing_a[k] += GetLane(chain.load_rhs[front.entry][k], front.lane);
      missing_b[k] += GetLane(chain.load_rhs[back.entry][k], back.lane);
    }
  dissipation_rate_ = 0;
  for (int lane = 0; lane < kLaneCount<T>; ++lane)
    if (layout.halves || lane == rod_lane) dissipation_rate_ += GetLane(chain.dissipation, lane);
  lost_in_step_ = 0;
  if (has_branch_stress()) dissipation_rate_ += h * CommitBranches(chain, rod_lane);
  address.fetched = false;
}

#define COSSERAT_CABLE_INSTANTIATE(T)                                                            \
  template void Rod::Impl::FillMasses(int, const ChainLayout&, std::vector<NodeMass<T>>*) const; \
  template void Rod::Impl::FillLaw(int, StepChain<T>*, double*) const;                           \
  template void Rod::Impl::FillBranches(int, StepChain<T>*) const;                               \
  template void Rod::Impl::HoldInChain(int, StepChain<T>*) const;                                \
  template void Rod::Impl::TakeState(const StepChain<T>&, int);                                  \
  template void Rod::Impl::TakeStep(const StepChain<T>&, int, double);
COSSERAT_CABLE_INSTANTIATE(WideLanes)
COSSERAT_CABLE_INSTANTIATE(Lanes)
COSSERAT_CABLE_INSTANTIATE(LanePair)
#undef COSSERAT_CABLE_INSTANTIATE

}  // namespace cosserat_cable::rod
