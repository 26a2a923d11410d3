// The state of a rod as a list of numbers.
#include "cosserat_cable/math/state_archive.h"
#include "rod_impl.h"

namespace cosserat_cable::rod {
namespace {

void Exchange(NodeRates<double>* rates, StateArchive* state) {
  state->Exchange(&rates->v, &rates->omega);
}

void Exchange(Vec6<double>* v, StateArchive* state) {
  for (double& x : v->v) state->Exchange(&x);
}

}  // namespace

void Rod::Impl::ExchangeState(StateArchive* state) {
  state->Exchange(&w.time);
  for (int i = 0; i < w.count; ++i) {
    NodeState& node = w.node[i];
    state->Exchange(&node.r, &node.q, &node.v, &node.omega);
    for (auto* rates : {&w.rate[i], &w.algorithm[i], &w.mean[i]}) Exchange(rates, state);
  }
  state->Exchange(&w.persistence.v, &w.persistence.omega, &tension);
  for (int e = 0; e < model.elements; ++e) {
    for (auto& along : shear[e]) state->Exchange(&along.g1, &along.G);
    Stiffening<double>& by = stiffening[e];
    for (auto* axis : {&by.x, &by.y})
      state->Exchange(&axis->C_M, &axis->V_M, &axis->C_F, &axis->V_F);
    state->Exchange(&by.bend_x, &by.bend_y, &by.along_chord);
    ElementStress& stress = stress_[e];
    state->Exchange(&stress.gamma, &stress.gamma_dot, &stress.kappa, &stress.kappa_dot, &stress.n,
                    &stress.m);
  }
  for (SectionValue& more : branch_stress_) state->Exchange(&more.F, &more.M);
  branches.ExchangeState(state);
  laws.ExchangeState(state);
  ends.a.ExchangeState(state);
  ends.b.ExchangeState(state);
  for (auto* missing : {&missing_a, &missing_b}) Exchange(missing, state);
  energy.ExchangeState(state);
  state->Exchange(&dissipation_rate_, &lost_in_step_, &lost_in_ends_, &has_history_);
}

std::vector<double> Rod::State() const {
  impl_->Fetch();
  StateArchive state;
  impl_->ExchangeState(&state);
  return state.numbers();
}

void Rod::SetState(const std::vector<double>& state) {
  impl_->MoveOut();
  StateArchive archive(state);
  impl_->ExchangeState(&archive);
  archive.Finish();
}

}  // namespace cosserat_cable::rod
