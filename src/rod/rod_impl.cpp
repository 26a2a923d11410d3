#include "rod_impl.h"

#include <algorithm>

#include "lane_access.h"

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
      branches(m.branches, m.elements),
      end_a(m.a),
      end_b(m.b),
      w(m.elements),
      shear(m.elements),
      stress(m.elements),
      missing_a{},
      missing_b{},
      end_a_before_(end_a),
      end_b_before_(end_b) {
  for (int i = 0; i < w.count; ++i) {
    const double share = (i == 0 || i == w.count - 1) ? 0.5 * h : h;
    w.mass[i] = share * m.section.rhoA;
    w.inertia[i] = share * ToSmall(m.section.rhoJ);
  }
  for (const LumpedBody& body : m.bodies) {
    const double position = std::clamp(body.s / h, 0.0, static_cast<double>(m.elements));
    const int left = std::min(static_cast<int>(position), m.elements - 1);
    const double share[] = {1 - (position - left), position - left};
    for (int k = 0; k < 2; ++k) {
      w.mass[left + k] += share[k] * body.mass;
      w.inertia[left + k] += share[k] * ToSmall(body.inertia);
    }
  }
  w.gravity = ToSmall(m.gravity);
  PrepareStatics();
}

void Rod::Impl::PrepareStatics() {
  const V3 none{};
  const SectionValue more = branches.StaticStiffness();
  w.law = {h,
           {shear1.static_stiffness(), shear2.static_stiffness(), model.section.C_F.z()},
           ToSmall(model.section.C_M),
           none,
           none,
           ToSmall(model.section.gamma0)};
  w.law.C_F += ToSmall(more.F);
  w.law.C_M += ToSmall(more.M);
  const V3 unbend = -Scale(w.law.C_M, ToSmall(model.section.kappa0));
  for (int e = 0; e < model.elements; ++e) w.chain.SetOffset(e, 0, none, unbend);
}

ElementLaw<double> Rod::Impl::LawOfStep(double dt) {
  shear1.BeginStep(dt);
  shear2.BeginStep(dt);
  ElementLaw<double> law = {h,
                            {shear1.C(), shear2.C(), model.section.C_F.z()},
                            ToSmall(model.section.C_M),
                            {shear1.V(), shear2.V(), model.section.V_F.z()},
                            ToSmall(model.section.V_M),
                            ToSmall(model.section.gamma0)};
  if (!branches.empty()) {
    branches.BeginStep(dt);
    const SectionValue more = branches.StepStiffness();
    law.C_F += ToSmall(more.F);
    law.C_M += ToSmall(more.M);
  }
  step_C_M = ToEigen(law.C_M);
  return law;
}

SectionValue Rod::Impl::Offset(int element) const {
  SectionValue offset;
  offset.F.x() = shear1.Offset(shear[element][0]);
  offset.F.y() = shear2.Offset(shear[element][1]);
  offset.M = -step_C_M.cwiseProduct(model.section.kappa0);
  if (!branches.empty()) offset += branches.Offset(element);
  return offset;
}

void Rod::Impl::MoveEnds(const StepCoefficients& c, const Pose& a, const Pose& b) {
  if (!energy.open()) energy.Open({EndPower(), 0, DissipationRate()}, StoredEnergy());
  end_a_before_ = end_a;
  end_b_before_ = end_b;
  end_a.MoveTo(a, c);
  end_b.MoveTo(b, c);
  if (model.a.clamped())
    Hold(end_a.clamp(), w.node.front(), &w.trial.front(), &w.trial_rate.front());
  if (model.b.clamped()) Hold(end_b.clamp(), w.node.back(), &w.trial.back(), &w.trial_rate.back());
}

void Rod::Impl::TakeBackEnds() {
  end_a = end_a_before_;
  end_b = end_b_before_;
}

ElementStrain Rod::Impl::StrainOf(int e) const {
  return {ToEigen(stress[e].gamma) - model.section.gamma0, ToEigen(stress[e].gamma_dot),
          ToEigen(stress[e].kappa) - model.section.kappa0, ToEigen(stress[e].kappa_dot)};
}

template <class T>
void Rod::Impl::TakeStresses(const StepWorkspace<T>& from, int lane, bool at_rest) {
  missing_a = GetLane(from.rhs.front(), lane);
  missing_b = GetLane(from.rhs.back(), lane);
  for (int e = 0; e < model.elements; ++e) {
    stress[e] = from.chain.Stress(e, lane);
    const ElementStrain strain = StrainOf(e);
    const Eigen::Vector3d &gamma = strain.gamma, &rate = strain.gamma_dot;
    if (at_rest) {
      shear[e] = {shear1.Rest(gamma.x()), shear2.Rest(gamma.y())};
      branches.Rest(e, strain);
    } else {
      shear[e] = {shear1.Commit(shear[e][0], gamma.x(), rate.x()),
                  shear2.Commit(shear[e][1], gamma.y(), rate.y())};
      branches.Commit(e, strain);
    }
  }
}

template void Rod::Impl::TakeStresses(const StepWorkspace<double>&, int, bool);
template void Rod::Impl::TakeStresses(const StepWorkspace<Lanes>&, int, bool);

}  // namespace cosserat_cable::rod
