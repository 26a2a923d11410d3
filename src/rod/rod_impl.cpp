#include "rod_impl.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable::rod {
namespace {

/// Adds a load's forces to the right-hand side and its derivatives to the tangent.
class SystemSink : public LoadSink {
 public:
  SystemSink(std::vector<Vec6<Scalar>>* rhs, BlockTridiagonal<Scalar>* system, double rate_factor)
      : rhs_(rhs), system_(system), rate_factor_(rate_factor) {}

  void AddForce(int element, double xi, const V3& force, const Mat3<double>& by_position,
                const Mat3<double>& by_velocity) override {
    const double weight[2] = {1 - xi, xi};
    for (int k = 0; k < 2; ++k) {
      Vec6<Scalar>& b = (*rhs_)[element + k];
      b[0] += weight[k] * force.x;
      b[1] += weight[k] * force.y;
      b[2] += weight[k] * force.z;
    }
    if (!system_) return;
    const Mat3<double> k = -1.0 * (by_position + rate_factor_ * by_velocity);
    system_->diagonal(element).AddQuarter(0, 0, (weight[0] * weight[0]) * k);
    system_->diagonal(element + 1).AddQuarter(0, 0, (weight[1] * weight[1]) * k);
    system_->lower(element).AddQuarter(0, 0, (weight[0] * weight[1]) * k);
  }

 private:
  std::vector<Vec6<Scalar>>* rhs_;
  BlockTridiagonal<Scalar>* system_;
  double rate_factor_;
};

ShearSeries MakeShearSeries(const Section& section, double h, int shear_axis, int bending_axis) {
  return ShearSeries(section.C_F[shear_axis], section.V_F[shear_axis],
                     12 * section.C_M[bending_axis] / (h * h),
                     12 * section.V_M[bending_axis] / (h * h));
}

}  // namespace

Rod::Impl::Impl(const RodModel& m)
    : model(m),
      count(m.elements + 1),
      h(m.length / m.elements),
      mass(count),
      inertia(count),
      gravity(ToSmall(m.gravity)),
      shear1(MakeShearSeries(m.section, h, 0, 1)),  // shear along a1 goes with bending about a2
      shear2(MakeShearSeries(m.section, h, 1, 0)),
      node(count),
      rate(count),
      algorithm(count),
      shear(m.elements),
      trial(count),
      chain(m.elements),
      system(count),
      rhs(count),
      increment(count),
      trial_rate(count),
      trial_algorithm(count) {
  for (int i = 0; i < count; ++i) {
    const double share = (i == 0 || i == count - 1) ? 0.5 * h : h;
    mass[i] = share * m.section.rhoA;
    inertia[i] = share * ToSmall(m.section.rhoJ);
  }
  for (const PointMass& point : m.masses) {
    const double position = std::clamp(point.s / h, 0.0, static_cast<double>(m.elements));
    const int left = std::min(static_cast<int>(position), m.elements - 1);
    mass[left] += (1 - (position - left)) * point.mass;
    mass[left + 1] += (position - left) * point.mass;
  }
  law.h = h;
  law.gamma0 = ToSmall(m.section.gamma0);
  law.kappa0 = ToSmall(m.section.kappa0);
  law.C_M = ToSmall(m.section.C_M);
}

void Rod::Impl::PrepareStatics() {
  law.C_F = {shear1.static_stiffness(), shear2.static_stiffness(), model.section.C_F.z()};
  law.V_F = law.V_M = V3{};
  chain.ClearOffsets();
}

void Rod::Impl::PrepareStep(double dt) {
  shear1.BeginStep(dt);
  shear2.BeginStep(dt);
  law.C_F = {shear1.C(), shear2.C(), model.section.C_F.z()};
  law.V_F = {shear1.V(), shear2.V(), model.section.V_F.z()};
  law.V_M = ToSmall(model.section.V_M);
  for (int e = 0; e < model.elements; ++e)
    chain.SetOffset(e, {shear1.Offset(shear[e][0]), shear2.Offset(shear[e][1]), 0.0});
}

void Rod::Impl::EvaluateForces() {
  for (int i = 0; i < count; ++i)
    rhs[i] = {{mass[i] * gravity.x, mass[i] * gravity.y, mass[i] * gravity.z, 0, 0, 0}};
  chain.Evaluate(trial.data(), law, rhs.data());
}

void Rod::Impl::AddLoad(const Load& load, bool tangent, double rate_factor) {
  SystemSink sink(&rhs, tangent ? &system : nullptr, rate_factor);
  load.Evaluate(*this, &sink);
}

void Rod::Impl::AssembleTangent(double rate_factor) {
  chain.AssembleTangent(law.h, law.C_F + rate_factor * law.V_F, law.C_M + rate_factor * law.V_M,
                        &system);
}

double Rod::Impl::CorrectionNorm() const {
  double translation = 0, rotation = 0;
  for (int i = first_free(); i <= last_free(); ++i)
    for (int k = 0; k < 3; ++k) {
      translation = std::max(translation, std::abs(rhs[i][k]));
      rotation = std::max(rotation, std::abs(rhs[i][3 + k]));
    }
  // std::max drops a NaN on its right: a sum does not.
  double sum = 0;
  for (int i = first_free(); i <= last_free(); ++i)
    for (int k = 0; k < 6; ++k) sum += rhs[i][k];
  if (!std::isfinite(sum)) return std::numeric_limits<double>::infinity();
  return std::max(translation / model.length, rotation);
}

double Rod::Impl::StrainEnergy() const {
  double energy = 0;
  for (int e = 0; e < model.elements; ++e) {
    const V3 gamma = chain.gamma(e) - law.gamma0, kappa = chain.kappa(e) - law.kappa0;
    energy += 0.5 * h * (Dot(gamma, Scale(law.C_F, gamma)) + Dot(kappa, Scale(law.C_M, kappa)));
  }
  return energy;
}

double Rod::Impl::GravityEnergy(const std::vector<NodeState>& nodes) const {
  double energy = 0;
  for (int i = 0; i < count; ++i) energy -= mass[i] * Dot(gravity, nodes[i].r);
  return energy;
}

}  // namespace cosserat_cable::rod
