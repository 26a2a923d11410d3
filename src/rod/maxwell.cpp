#include "cosserat_cable/rod/maxwell.h"

#include <cmath>

namespace cosserat_cable::rod {

MaxwellBranch::MaxwellBranch(const SectionValue& stiffness, double tau)
    : stiffness_(stiffness.F.z(), stiffness.M.x(), stiffness.M.y(), stiffness.M.z()), tau_(tau) {}

std::unique_ptr<SectionBranch> MaxwellBranch::Clone() const {
  return std::make_unique<MaxwellBranch>(*this);
}

void MaxwellBranch::ExchangeState(StateArchive* state) {
  for (State& of : states_) state->Exchange(&of.sigma, &of.strain);
}

void MaxwellBranch::SetElements(int elements) { states_.assign(elements, State()); }

void MaxwellBranch::BeginStep(double dt) {
  const double x = dt / tau_;
  decay_ = std::exp(-x);
  mean_decay_ = -std::expm1(-x) / x;
}

SectionValue MaxwellBranch::StepStiffness() const { return Spread(mean_decay_ * stiffness_); }

SectionValue MaxwellBranch::Offset(int element) const {
  const State& state = states_[element];
  return Spread(decay_ * state.sigma - mean_decay_ * stiffness_ * state.strain);
}

void MaxwellBranch::Commit(int element, const ElementStrain& strain) {
  State& state = states_[element];
  const Components now = Pick(strain);
  state.sigma = decay_ * state.sigma + mean_decay_ * stiffness_ * (now - state.strain);
  state.strain = now;
}

void MaxwellBranch::Rest(int element, const ElementStrain& strain) {
  states_[element] = {Components::Zero(), Pick(strain)};
}

double MaxwellBranch::Energy(int element) const {
  const Components& sigma = states_[element].sigma;
  return (stiffness_ > 0).select(0.5 * sigma * sigma / stiffness_, 0.0).sum();
}

double MaxwellBranch::DissipationRate(int element) const { return 2 * Energy(element) / tau_; }

}  // namespace cosserat_cable::rod
