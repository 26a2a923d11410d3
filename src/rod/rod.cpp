#include "cosserat_cable/rod/rod.h"

#include "rod_impl.h"
#include "step_kernels.h"

namespace cosserat_cable::rod {
namespace {

/// `missing`: force in the world's axes and moment in the section's that the node lacks to balance.
Wrench ClampWrench(const Vec6<double>& missing, const Eigen::Quaterniond& q) {
  const Eigen::Vector3d force(-missing[0], -missing[1], -missing[2]);
  const Eigen::Vector3d moment(-missing[3], -missing[4], -missing[5]);
  return {force, q * moment};
}

}  // namespace

Rod::Rod(const RodModel& model) : impl_(std::make_unique<Impl>(model)) {}
Rod::~Rod() = default;
Rod::Rod(const Rod& other) : Centreline(other), impl_(std::make_unique<Impl>(*other.impl_)) {}
Rod::Rod(Rod&&) noexcept = default;
Rod& Rod::operator=(Rod&&) noexcept = default;

const RodModel& Rod::model() const { return impl_->model; }
int Rod::elements() const { return impl_->model.elements; }

void Rod::SetConfiguration(const std::vector<Pose>& nodes) {
  Impl& m = *impl_;
  for (int i = 0; i < m.w.count; ++i) {
    NodeState& n = m.w.node[i];
    n = NodeState{ToSmall(nodes[i].p), Normalized(ToSmall(nodes[i].q)), V3{}, V3{}};
    if (i > 0 && Dot(n.q, m.w.node[i - 1].q) < 0) n.q = {-n.q.w, -n.q.x, -n.q.y, -n.q.z};
    m.w.rate[i] = m.w.algorithm[i] = NodeRates<double>{};
  }
  m.w.trial = m.w.node;
  m.PrepareStatics();
  EvaluateForces(&m.w);
  m.TakeRest();
}

void Rod::AddRigidMotion(const Eigen::Vector3d& p, const Eigen::Vector3d& v,
                         const Eigen::Vector3d& omega) {
  for (NodeState& n : impl_->w.node) {
    n.v += ToSmall(v + omega.cross(ToEigen(n.r) - p));
    n.omega += ToSmall(ToEigen(n.q).conjugate() * omega);
  }
}

SolveReport Rod::Step(double dt, const Motion& a, const Motion& b, const Load* load) {
  Impl& m = *impl_;
  if (!m.pair.chain) {
    m.pair.chain = std::make_unique<StepChain<LanePair>>(ChainLayout::Halves(m.model.elements));
    m.pair.chain->SetHeld(m.model.held_a, m.model.held_b);
    m.FillMasses(0, m.pair.chain->layout, &m.pair.chain->masses);
  }
  StepChain<LanePair>& chain = *m.pair.chain;
  const StepCoefficients c(dt);
  m.BeginStep(dt, a, b);
  m.FillChain(0, &chain);
  const RodState state = m.State();
  const RodState halves[] = {state, state};
  rod::Predict(c, halves, &chain);
  m.HoldInChain(0, &chain);
  StepOfRod step{true, m.model.length, load, {}};
  SolveStep(c, &chain, &step);
  if (!step.report.converged) return step.report;
  m.TakeStep(chain, 0);
  const RodState* accepting[] = {&state, &state};
  Accept(c, chain, accepting);
  return step.report;
}

void Rod::Predict(double dt, const Motion& a, const Motion& b,
                  std::vector<Eigen::Vector3d>* positions) const {
  const Impl& m = *impl_;
  positions->resize(m.w.count);
  for (int i = 0; i < m.w.count; ++i) (*positions)[i] = ToEigen(m.w.node[i].r + dt * m.w.node[i].v);
  if (m.model.held_a) positions->front() = a.X.p;
  if (m.model.held_b) positions->back() = b.X.p;
}

V3 Rod::position(int i) const { return impl_->w.node[i].r; }
V3 Rod::velocity(int i) const { return impl_->w.node[i].v; }
Pose Rod::pose(int i) const { return {ToEigen(impl_->w.node[i].r), ToEigen(impl_->w.node[i].q)}; }
Eigen::Vector3d Rod::angular_velocity(int i) const { return ToEigen(impl_->w.node[i].omega); }
Eigen::Vector3d Rod::acceleration(int i) const { return ToEigen(impl_->w.rate[i].v); }
Eigen::Vector3d Rod::force(int e) const { return ToEigen(impl_->Stress(e).n); }
Eigen::Vector3d Rod::moment(int e) const { return ToEigen(impl_->Stress(e).m); }
Eigen::Vector3d Rod::curvature(int e) const { return ToEigen(impl_->Stress(e).kappa); }

Wrench Rod::reaction_a() const {
  return ClampWrench(impl_->missing_a, ToEigen(impl_->w.node.front().q));
}
Wrench Rod::reaction_b() const {
  return ClampWrench(impl_->missing_b, ToEigen(impl_->w.node.back().q));
}

double Rod::kinetic_energy() const {
  double energy = 0;
  for (int i = 0; i < impl_->w.count; ++i) {
    const NodeState& n = impl_->w.node[i];
    energy += 0.5 * (impl_->w.mass[i] * Dot(n.v, n.v) +
                     Dot(n.omega, Scale(impl_->w.inertia[i], n.omega)));
  }
  return energy;
}
double Rod::elastic_energy() const {
  impl_->Stress(0);
  return impl_->StrainEnergy();
}
double Rod::gravity_energy() const { return impl_->GravityEnergy(impl_->w.node); }

}  // namespace cosserat_cable::rod
