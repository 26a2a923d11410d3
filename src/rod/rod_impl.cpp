#include "rod_impl.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "step_kernels.h"

namespace cosserat_cable::rod {
namespace {

ShearSeries MakeShearSeries(const Section& section, double h, int shear_axis, int bending_axis) {
  return ShearSeries(section.C_F[shear_axis], section.V_F[shear_axis],
                     12 * section.C_M[bending_axis] / (h * h),
                     12 * section.V_M[bending_axis] / (h * h));
}

std::vector<Quat<double>> JointsByNode(const RodModel& model) {
  constexpr double kOnNode = 1e-6;  // of an element
  std::vector<Quat<double>> joints;
  for (const Joint& joint : model.joints) {
    const double position = joint.s / model.length * model.elements;
    const int node = static_cast<int>(std::lround(position));
    if (std::abs(position - node) > kOnNode || node < 1 || node >= model.elements)
      throw std::invalid_argument("a joint is at a node between the ends");
    if (joints.empty()) joints.assign(model.elements + 1, {1, 0, 0, 0});
    joints[node] = ToSmall(joint.turn.normalized());
  }
  return joints;
}

/// Puts the load that is given in its place, the last.
const Load* With(const Load* given, LoadSum* sum) {
  if (sum->loads.empty()) return given;
  static const LoadSum none;
  sum->loads.back() = given ? given : &none;
  return sum;
}

}  // namespace

Rod::Impl::Impl(const RodModel& m)
    : model(m),
      h(m.length / m.elements),
      shear1(MakeShearSeries(m.section, h, 0, 1)),  // shear along a1 goes with bending about a2
      shear2(MakeShearSeries(m.section, h, 1, 0)),
      branches(m.branches, m.elements),
      laws(m.laws, m.elements),
      joints(JointsByNode(m)),
      ends{EndPart(m.a), EndPart(m.b)},
      w(m.elements),
      shear(m.elements),
      tension(m.elements, 0.0),
      stiffening(m.elements, Stiffening<double>{}),
      missing_a{},
      missing_b{},
      law_of_step_{},
      stress_(m.elements),
      branch_stress_(m.branches.empty() && m.laws.empty() ? 0 : m.elements) {
  for (int i = 0; i < w.count; ++i) {
    const double share = (i == 0 || i == w.count - 1) ? 0.5 * h : h;
    w.mass[i] = share * m.section.rhoA;
    w.inertia[i] = share * ToSmall(m.section.rhoJ);
  }
  if (!joints.empty()) {
    std::vector<ElementJoint<double>> seen;
    const Quat<double> straight{1, 0, 0, 0};
    for (int e = 0; e < m.elements; ++e) seen.push_back({joints[e], straight});
    w.chain.SetJoints(std::move(seen));
    // Half of a joint's node belongs to the piece behind it: the diagonal of its turned inertia.
    for (int i = 1; i < m.elements; ++i) {
      const Eigen::Matrix3d J = ToEigen(joints[i]).toRotationMatrix();
      w.inertia[i] =
          0.5 * w.inertia[i] +
          ToSmall((J * (0.5 * h * m.section.rhoJ).asDiagonal() * J.transpose()).diagonal().eval());
    }
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
  for (const auto& load : m.loads) {
    acting_.loads.push_back(load.get());
    if (load->ActsAtRest()) acting_at_rest_.loads.push_back(load.get());
  }
  for (LoadSum* sum : {&acting_, &acting_at_rest_})
    if (!sum->loads.empty()) sum->loads.push_back(nullptr);  // room for the one that is given
  PrepareStatics();
}

Rod::Impl::~Impl() {
  if (address.home) address.home->MoveOut(address.lane);
}

void Rod::Impl::Fetch() {
  if (address.fetched) return;
  address.home->Fetch(address.lane, this);
  address.fetched = true;
}

void Rod::Impl::MoveOut() {
  Fetch();
  if (address.home) address.home->MoveOut(address.lane);
  address.home = nullptr;
}

void Rod::Impl::SetSection(const Section& section) {
  Fetch();
  const bool counted = energy.open() && !energy.waits();
  const double before = counted ? ElasticEnergy() : 0.0;
  const Section old = std::exchange(model.section, section);
  model.section.rhoA = old.rhoA;
  model.section.rhoJ = old.rhoJ;
  shear1 = MakeShearSeries(model.section, h, 0, 1);
  shear2 = MakeShearSeries(model.section, h, 1, 0);
  const BeamColumn<double> column = Column();
  for (int e = 0; e < model.elements; ++e)
    if (stiffening[e].x.C_M != 0 || stiffening[e].y.C_M != 0)
      stiffening[e] = EvaluateStiffening(column, tension[e]);
  dt_of_law_ = 0;
  if (address.home) address.home->ForgetLaw(address.lane);
  if (counted) energy.AddSectionChange(ElasticEnergy() - before);
}

const Load* Rod::Impl::Acting(const Load* given) { return With(given, &acting_); }
const Load* Rod::Impl::ActingAtRest(const Load* given) { return With(given, &acting_at_rest_); }

void Rod::Impl::BeginHistory() {
  if (has_history_) return;
  has_history_ = true;
  ends.a.CommitLaws(w.node.front(), EndPart::Memory::kRested);
  ends.b.CommitLaws(w.node.back(), EndPart::Memory::kRested);
}

void Rod::Impl::PrepareStatics() {
  const V3 none{};
  const SectionValue more = branches.StaticStiffness();
  w.law = {h,
           {shear1.static_stiffness(), shear2.static_stiffness(), model.section.C_F.z()},
           ToSmall(model.section.C_M),
           none,
           none,
           ToSmall(model.section.gamma0),
           SlackBowing(),
           Column()};
  w.law.C_F += ToSmall(more.F);
  w.law.C_M += ToSmall(more.M);
  const V3 unbend = -Scale(w.law.C_M, ToSmall(model.section.kappa0));
  for (int e = 0; e < model.elements; ++e) w.chain.SetOffset(e, 0, none, unbend);
  StiffenElements();
}

Bowing<double> Rod::Impl::SlackBowing() const {
  const double arc = h / 24, bent1 = shear1.bending_part(), bent2 = shear2.bending_part();
  const double along_chord = 1 - (1 - bent1) * (1 - bent2) + 0.2 * bent1 * bent2;
  return {1 - along_chord, along_chord, arc, arc, arc};
}

BeamColumn<double> Rod::Impl::Column() const {
  const Section& s = model.section;
  const auto axis = [&](double EI, double eta_EI, double bent) {
    const double by_shear = 12 * bent * bent / (h * h);
    return BeamColumnAxis<double>{h * h / (4 * EI), EI, eta_EI, by_shear * EI, by_shear * eta_EI};
  };
  const double bent1 = shear1.bending_part(), bent2 = shear2.bending_part();
  return {axis(s.C_M.x(), s.V_M.x(), bent2), axis(s.C_M.y(), s.V_M.y(), bent1), h, bent1 * bent2};
}

void Rod::Impl::StiffenElements() {
  for (int e = 0; e < model.elements; ++e) {
    stiffening[e] = EvaluateStiffening(w.law.column, tension[e]);
    w.chain.SetStiffening(e, 0, stiffening[e]);
  }
}

double Rod::Impl::UpdateTensions() {
  double change = 0;
  for (int e = 0; e < model.elements; ++e) {
    tension[e] = w.chain.Stress(e, 0).n.z;
    const AxisStiffening<double> before[] = {stiffening[e].x, stiffening[e].y};
    stiffening[e] = EvaluateStiffening(w.law.column, tension[e]);
    w.chain.SetStiffening(e, 0, stiffening[e]);
    change =
        std::max({change, std::abs(stiffening[e].x.C_M - before[0].C_M) / model.section.C_M.x(),
                  std::abs(stiffening[e].y.C_M - before[1].C_M) / model.section.C_M.y()});
  }
  return change;
}

ElementLaw<double> Rod::Impl::LawOfStep(double dt) {
  shear1.BeginStep(dt);
  shear2.BeginStep(dt);
  ElementLaw<double> law_of_step = {h,
                                    {shear1.C(), shear2.C(), model.section.C_F.z()},
                                    ToSmall(model.section.C_M),
                                    {shear1.V(), shear2.V(), model.section.V_F.z()},
                                    ToSmall(model.section.V_M),
                                    ToSmall(model.section.gamma0),
                                    SlackBowing(),
                                    Column()};
  if (!branches.empty()) {
    branches.BeginStep(dt);
    const SectionValue more = branches.StepStiffness();
    law_of_step.C_F += ToSmall(more.F);
    law_of_step.C_M += ToSmall(more.M);
  }
  return law_of_step;
}

std::array<DynamicModulus, 6> Rod::Impl::Moduli() const {
  const Section& s = model.section;
  const auto kelvin_voigt = [](double C, double V) { return DynamicModulus{C, V, {}}; };
  std::array<DynamicModulus, 6> moduli = {shear1.modulus(),
                                          shear2.modulus(),
                                          kelvin_voigt(s.C_F.z(), s.V_F.z()),
                                          kelvin_voigt(s.C_M.x(), s.V_M.x()),
                                          kelvin_voigt(s.C_M.y(), s.V_M.y()),
                                          kelvin_voigt(s.C_M.z(), s.V_M.z())};
  branches.AddTo(&moduli);
  return moduli;
}

ElementStrain Rod::Impl::StrainOf(const ElementStress& now) const {
  return {ToEigen(now.gamma) - model.section.gamma0, ToEigen(now.gamma_dot),
          ToEigen(now.kappa) - model.section.kappa0, ToEigen(now.kappa_dot)};
}

void Rod::Impl::TakeRest() {
  missing_a = w.rhs.front();
  missing_b = w.rhs.back();
  const SectionValue relaxed = branches.StaticStiffness();
  for (int e = 0; e < model.elements; ++e) {
    stress_[e] = w.chain.Stress(e, 0);
    const ElementStrain strain = StrainOf(stress_[e]);
    shear[e] = {shear1.Rest(strain.gamma.x()), shear2.Rest(strain.gamma.y())};
    branches.Rest(e, strain);
    if (memory_ == EndPart::Memory::kRested)
      laws.Rest(e, strain);
    else
      laws.Commit(e, strain);
    if (!has_branch_stress()) continue;
    branch_stress_[e].F = relaxed.F.cwiseProduct(strain.gamma);
    branch_stress_[e].M = relaxed.M.cwiseProduct(strain.kappa);
    if (!laws.empty()) branch_stress_[e] += Split(laws.Evaluate(e, strain, 0).stress);
  }
  dissipation_rate_ = 0;
  ends.a.CommitLaws(w.trial.front(), memory_);
  ends.b.CommitLaws(w.trial.back(), memory_);
  has_history_ = true;
  energy.Close();
}

}  // namespace cosserat_cable::rod
