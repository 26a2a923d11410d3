#include "chain_stepper.h"

#include <algorithm>

#include "chain_advance.h"
#include "cosserat_cable/math/flush_subnormals.h"
#include "lane_access.h"
#include "rod_impl.h"

namespace cosserat_cable::rod {

template <class T>
ChainStepper<T>::ChainStepper(const ChainLayout& layout, const Rod::Impl& alike) : chain_(layout) {
  chain_.SetHeld(alike.model.a.clamped(), alike.model.b.clamped());
  if (!alike.joints.empty()) chain_.SetJointed();
  if (!alike.laws.empty()) chain_.SetNonlinear();
}

template <class T>
ChainStepper<T>::~ChainStepper() {
  for (Rod::Impl* rod : residents_)
    if (rod) rod->MoveOut();
}

template <class T>
void ChainStepper<T>::CopyState(int rod_lane, const Rod::Impl& rod) {
  const ChainLayout& layout = chain_.layout;
  rod.FillMasses(rod_lane, layout, &chain_.masses);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (!layout.halves && lane != rod_lane) continue;
    SetLane(&chain_.persistence, lane, rod.w.persistence);
    for (int k = 0; k <= layout.chain_elements; ++k) {
      const int i = std::max(0, layout.NodeAt(k, lane));
      SetLane(&chain_.state[k].at, lane, rod.w.node[i]);
      SetLane(&chain_.state[k].rate, lane, rod.w.rate[i]);
      SetLane(&chain_.state[k].algorithm, lane, rod.w.algorithm[i]);
      SetLane(&chain_.state[k].mean, lane, rod.w.mean[i]);
    }
    for (int k = 0; k < layout.chain_elements; ++k) {
      const int e = layout.ElementAt(k, lane);
      SetLane(&chain_.shear[k], lane, rod.shear[std::max(0, e)]);
      SetLane(&chain_.tension[k], lane, e < 0 ? 0.0 : rod.tension[e]);
    }
  }
}

template <class T>
void ChainStepper<T>::MoveIn(int lane, Rod::Impl* rod) {
  if (residents_[lane] == rod) return;
  if (residents_[lane]) residents_[lane]->MoveOut();
  rod->MoveOut();
  CopyState(lane, *rod);
  residents_[lane] = rod;
  dt_of_law_[lane] = 0;
  rod->address.home = this;
  rod->address.lane = lane;
  strains_known_ = false;
}

template <class T>
void ChainStepper<T>::Fetch(int lane, Rod::Impl* rod) {
  if (!strains_known_) EvaluateStrains(&chain_);
  strains_known_ = true;
  rod->TakeState(chain_, lane);
}

template <class T>
Node<double> ChainStepper<T>::NodeAt(int lane, int i) const {
  const ChainLayout::Place at = chain_.layout.OfNode(i, lane);
  return GetLane(chain_.state[at.entry].at, at.lane);
}

template <class T>
void ChainStepper<T>::Predict(int lane, double dt, std::vector<Eigen::Vector3d>* positions) const {
  for (int i = 0; i <= chain_.layout.elements; ++i) {
    const ChainLayout::Place at = chain_.layout.OfNode(i, lane);
    const Node<T>& node = chain_.state[at.entry].at;
    (*positions)[i] = ToEigen(GetLane(node.r, at.lane) + dt * GetLane(node.v, at.lane));
  }
}

template <class T>
void ChainStepper<T>::Step(double dt, int count, Rod::Impl* const* rods, const RodDrive* drives,
                           SolveReport* reports) {
  const FlushSubnormals flush;
  const StepCoefficients c(dt);
  StepOfRod steps[kLanes];
  chain_.branched = chain_.nonlinear = false;
  for (int l = 0; l < count; ++l) {
    Rod::Impl& rod = *rods[l];
    MoveIn(l, &rod);
    steps[l].ends = &rod.ends;
    if (drives[l].a) {
      steps[l] = {true,
                  rod.model.length,
                  rod.Acting(drives[l].load),
                  rod.w.time + dt,
                  &rod.ends,
                  rod.LawsOfStep(),
                  {},
                  {}};
      rod.BeginStep(c, *drives[l].a, *drives[l].b);
    }
    rod.FillLaw(l, &chain_, &dt_of_law_[l]);
    chain_.branched |= rod.has_branch_stress();
    chain_.nonlinear |= !rod.laws.empty();
  }
  if (chain_.nonlinear) chain_.SetNonlinear();
  // Lanes without a rod repeat the first one as it was at first, and never move.
  for (int l = count; l < kLanes && !chain_.layout.halves; ++l) {
    if (!filled_) CopyState(l, *rods[0]);
    rods[0]->FillLaw(l, &chain_, &dt_of_law_[l]);
    steps[l].ends = &rods[0]->ends;
  }
  filled_ = true;
  if (chain_.branched)
    for (int l = 0; l < count; ++l) rods[l]->FillBranches(l, &chain_);
  rod::Predict(c, &chain_);
  for (int l = 0; l < count; ++l) rods[l]->HoldInChain(l, &chain_);
  SolveStep(c, &chain_, steps);

  T taken(0.0);
  for (int l = 0; l < kLanes; ++l)
    if (steps[chain_.layout.halves ? 0 : l].report.converged) SetLane(&taken, l, 1.0);
  Accept(c, taken, &chain_);
  strains_known_ = false;
  for (int l = 0; l < count; ++l) {
    reports[l] = steps[l].report;
    if (reports[l].converged)
      rods[l]->TakeStep(chain_, l, dt);
    else if (steps[l].active)
      rods[l]->TakeBackStep();
  }
  // Last: who opens an account asks for the state, which replaces the strains of all lanes.
  for (int l = 0; l < count; ++l)
    if (reports[l].converged) rods[l]->AccountForStep(dt, steps[l].load_power);
}

template class ChainStepper<WideLanes>;
template class ChainStepper<Lanes>;
template class ChainStepper<LanePair>;

}  // namespace cosserat_cable::rod
