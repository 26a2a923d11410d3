// What a rod stores, what its ends put in and what its sections turn into heat.
#include "rod_impl.h"

namespace cosserat_cable::rod {

double Rod::Impl::StaticEnergy() const {
  double energy = 0;
  const V3 kappa0 = ToSmall(model.section.kappa0);
  for (int e = 0; e < model.elements; ++e) {
    const ElementStress now = w.chain.Stress(e, 0);
    const V3 gamma = now.gamma - w.law.gamma0, kappa = now.kappa - kappa0;
    energy +=
        0.5 * h * (Dot(gamma, Scale(w.law.C_F, gamma)) + Dot(kappa, Scale(w.law.C_M, kappa))) +
        h * StiffeningEnergy(e, now.gamma, now.kappa);
    if (!laws.empty()) energy += h * laws.Potential(e, StrainOf(now));
  }
  return energy + ends.a.SpringPotential(w.trial.front(), memory_) +
         ends.b.SpringPotential(w.trial.back(), memory_);
}

double Rod::Impl::StiffeningEnergy(int element, const V3& gamma, const V3& kappa) const {
  const Stiffening<double>& by = stiffening[element];
  return 0.5 * (by.y.C_F * gamma.x * gamma.x + by.x.C_F * gamma.y * gamma.y +
                by.x.C_M * kappa.x * kappa.x + by.y.C_M * kappa.y * kappa.y);
}

double Rod::Impl::GravityEnergy(const std::vector<NodeState>& nodes) const {
  double energy = 0;
  for (int i = 0; i < w.count; ++i) energy -= w.mass[i] * Dot(w.gravity, nodes[i].r);
  return energy;
}

double Rod::Impl::KineticEnergy() const {
  double energy = 0;
  for (int i = 0; i < w.count; ++i) {
    const NodeState& n = w.node[i];
    energy += 0.5 * (w.mass[i] * Dot(n.v, n.v) + Dot(n.omega, Scale(w.inertia[i], n.omega)));
  }
  return energy;
}

double Rod::Impl::ElasticEnergy() const {
  double energy = 0;
  for (int e = 0; e < model.elements; ++e) {
    const ElementStrain strain = StrainOf(Stress(e));
    const Eigen::Vector3d &gamma = strain.gamma, &kappa = strain.kappa;
    energy += h * (shear1.Energy(shear[e][0], gamma.x()) + shear2.Energy(shear[e][1], gamma.y()) +
                   0.5 * model.section.C_F.z() * gamma.z() * gamma.z() +
                   0.5 * kappa.dot(model.section.C_M.cwiseProduct(kappa)) + branches.Energy(e) +
                   StiffeningEnergy(e, Stress(e).gamma, Stress(e).kappa));
    if (!laws.empty()) energy += h * laws.Energy(e, strain);
  }
  return energy + ends.a.SpringEnergy(w.node.front()) + ends.b.SpringEnergy(w.node.back());
}

double Rod::Impl::StoredEnergy() const {
  return KineticEnergy() + ElasticEnergy() + GravityEnergy(w.node);
}

double Rod::Impl::EndPower() const {
  const auto power = [](const EndPart& end, const NodeState& node, const Vec6<double>& missing) {
    if (!end.bears()) return 0.0;
    return end.Power(node, {-missing[0], -missing[1], -missing[2]},
                     {-missing[3], -missing[4], -missing[5]});
  };
  return power(ends.a, w.node.front(), missing_a) + power(ends.b, w.node.back(), missing_b);
}

void Rod::Impl::AccountForStep(double dt, const LoadPower& loads) {
  const double in_ends =
      ends.a.SpringDissipationRate(w.node.front()) + ends.b.SpringDissipationRate(w.node.back());
  const EnergyBook::Flow flow = {EndPower(), loads.work,
                                 dissipation_rate_ + in_ends + loads.dissipation,
                                 lost_in_step_ + lost_in_ends_};
  if (!energy.waits()) {
    energy.Add(dt, flow);
    return;
  }
  Fetch();
  energy.Open(flow, StoredEnergy());
}

EnergyBalance Rod::energy_balance() const {
  impl_->Fetch();
  return impl_->energy.Balance(impl_->StoredEnergy());
}
double Rod::kinetic_energy() const {
  impl_->Fetch();
  return impl_->KineticEnergy();
}
double Rod::elastic_energy() const {
  impl_->Fetch();
  return impl_->ElasticEnergy();
}
double Rod::gravity_energy() const {
  impl_->Fetch();
  return impl_->GravityEnergy(impl_->w.node);
}

}  // namespace cosserat_cable::rod
