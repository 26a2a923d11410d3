#include "rod_impl.h"

#include <algorithm>

#include "step_kernels.h"

namespace cosserat_cable::rod {
namespace {

ShearSeries MakeShearSeries(const Section& section, double h, int shear_axis, int bending_axis) {
  return ShearSeries(section.C_F[shear_axis], section.V_F[shear_axis],
                     12 * section.C_M[bending_axis] / (h * h),
                     12 * section.V_M[bending_axis] / (h * h));
}

void Hold(const Motion& motion, const NodeState& before, NodeState* node, NodeRates<double>* rate) {
  node->r = ToSmall(motion.X.p);
  node->q = ToSmall(motion.X.q);
  // q and -q are the same rotation: stay on the side from which the neighbours were reached.
  if (Dot(node->q, before.q) < 0) node->q = {-node->q.w, -node->q.x, -node->q.y, -node->q.z};
  node->v = ToSmall(motion.v);
  node->omega = ToSmall(motion.omega);
  *rate = {ToSmall(motion.a), ToSmall(motion.alpha)};
}

}  // namespace

Rod::Impl::Impl(const RodModel& m)
    : model(m),
      h(m.length / m.elements),
      shear1(MakeShearSeries(m.section, h, 0, 1)),  // shear along a1 goes with bending about a2
      shear2(MakeShearSeries(m.section, h, 1, 0)),
      w(m.elements),
      shear(m.elements),
      offsets(m.elements),
      missing_a{},
      missing_b{},
      next_offsets_(m.elements),
      stress_(m.elements) {
  for (int i = 0; i < w.count; ++i) {
    const double share = (i == 0 || i == w.count - 1) ? 0.5 * h : h;
    w.mass[i] = share * m.section.rhoA;
    w.inertia[i] = share * ToSmall(m.section.rhoJ);
  }
  for (const PointMass& point : m.masses) {
    const double position = std::clamp(point.s / h, 0.0, static_cast<double>(m.elements));
    const int left = std::min(static_cast<int>(position), m.elements - 1);
    w.mass[left] += (1 - (position - left)) * point.mass;
    w.mass[left + 1] += (position - left) * point.mass;
  }
  w.gravity = ToSmall(m.gravity);
  PrepareStatics();
}

void Rod::Impl::PrepareStatics() {
  const V3 none{};
  w.law = {h,
           {shear1.static_stiffness(), shear2.static_stiffness(), model.section.C_F.z()},
           ToSmall(model.section.C_M),
           none,
           none,
           ToSmall(model.section.gamma0)};
  const V3 unbend = MomentOfUnstressedCurvature();
  for (int e = 0; e < model.elements; ++e) w.chain.SetOffset(e, 0, none, unbend);
}

ElementLaw<double> Rod::Impl::LawOfStep(double dt) {
  shear1.BeginStep(dt);
  shear2.BeginStep(dt);
  return {h,
          {shear1.C(), shear2.C(), model.section.C_F.z()},
          ToSmall(model.section.C_M),
          {shear1.V(), shear2.V(), model.section.V_F.z()},
          ToSmall(model.section.V_M),
          ToSmall(model.section.gamma0)};
}

V3 Rod::Impl::MomentOfUnstressedCurvature() const {
  return -Scale(ToSmall(model.section.C_M), ToSmall(model.section.kappa0));
}

void Rod::Impl::HoldEnds(const Motion& a, const Motion& b) {
  if (model.held_a) Hold(a, w.node.front(), &w.trial.front(), &w.trial_rate.front());
  if (model.held_b) Hold(b, w.node.back(), &w.trial.back(), &w.trial_rate.back());
}

void Rod::Impl::TakeRest() {
  missing_a = w.rhs.front();
  missing_b = w.rhs.back();
  const V3 gamma0 = ToSmall(model.section.gamma0);
  for (int e = 0; e < model.elements; ++e) {
    stress_[e] = w.chain.Stress(e, 0);
    const V3 gamma = stress_[e].gamma - gamma0;
    shear[e] = {shear1.Rest(gamma.x), shear2.Rest(gamma.y)};
  }
  law = w.law;
  offsets.assign(model.elements, {V3{}, MomentOfUnstressedCurvature()});
  stress_known_ = true;
}

void Rod::Impl::EvaluateStress() {
  w.law = law;
  for (int e = 0; e < model.elements; ++e) w.chain.SetOffset(e, 0, offsets[e].F, offsets[e].M);
  w.trial = w.node;
  EvaluateForces(&w);
  for (int e = 0; e < model.elements; ++e) stress_[e] = w.chain.Stress(e, 0);
  stress_known_ = true;
}

const ElementStress& Rod::Impl::Stress(int element) {
  if (!stress_known_) EvaluateStress();
  return stress_[element];
}

double Rod::Impl::StrainEnergy() const {
  double energy = 0;
  const V3 kappa0 = ToSmall(model.section.kappa0);
  for (int e = 0; e < model.elements; ++e) {
    const ElementStress stress_of = w.chain.Stress(e, 0);
    const V3 gamma = stress_of.gamma - w.law.gamma0, kappa = stress_of.kappa - kappa0;
    energy += 0.5 * h * (Dot(gamma, Scale(w.law.C_F, gamma)) + Dot(kappa, Scale(w.law.C_M, kappa)));
  }
  return energy;
}

double Rod::Impl::GravityEnergy(const std::vector<NodeState>& nodes) const {
  double energy = 0;
  for (int i = 0; i < w.count; ++i) energy -= w.mass[i] * Dot(w.gravity, nodes[i].r);
  return energy;
}

}  // namespace cosserat_cable::rod
