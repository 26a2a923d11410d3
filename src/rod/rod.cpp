#include "cosserat_cable/rod/rod.h"

#include "rod_impl.h"

namespace cosserat_cable::rod {

Rod::Rod(const RodModel& model) : impl_(std::make_unique<Impl>(model)) {}
Rod::~Rod() = default;
Rod::Rod(const Rod& other) : Centreline(other), impl_(std::make_unique<Impl>(*other.impl_)) {}
Rod::Rod(Rod&&) noexcept = default;
Rod& Rod::operator=(Rod&&) noexcept = default;

const RodModel& Rod::model() const { return impl_->model; }
int Rod::elements() const { return impl_->model.elements; }

void Rod::SetConfiguration(const std::vector<Pose>& nodes) {
  Impl& m = *impl_;
  for (int i = 0; i < m.count; ++i) {
    NodeState& n = m.node[i];
    n = NodeState{ToSmall(nodes[i].p), Normalized(ToSmall(nodes[i].q)), V3{}, V3{}};
    if (i > 0 && Dot(n.q, m.node[i - 1].q) < 0) n.q = {-n.q.w, -n.q.x, -n.q.y, -n.q.z};
    m.rate[i] = m.algorithm[i] = NodeRates{};
  }
  m.trial = m.node;
  m.PrepareStatics();
  m.EvaluateForces();
  for (int e = 0; e < m.model.elements; ++e)
    m.shear[e] = {m.shear1.Rest(m.chain.gamma(e).x - m.law.gamma0.x),
                  m.shear2.Rest(m.chain.gamma(e).y - m.law.gamma0.y)};
}

void Rod::AddRigidMotion(const Eigen::Vector3d& p, const Eigen::Vector3d& v,
                         const Eigen::Vector3d& omega) {
  Impl& m = *impl_;
  for (NodeState& n : m.node) {
    n.v += ToSmall(v + omega.cross(ToEigen(n.r) - p));
    n.omega += ToSmall(ToEigen(n.q).conjugate() * omega);
  }
  m.trial = m.node;
}

V3 Rod::position(int i) const { return impl_->node[i].r; }
V3 Rod::velocity(int i) const { return impl_->node[i].v; }
Pose Rod::pose(int i) const { return {ToEigen(impl_->node[i].r), ToEigen(impl_->node[i].q)}; }
Eigen::Vector3d Rod::angular_velocity(int i) const { return ToEigen(impl_->node[i].omega); }
Eigen::Vector3d Rod::acceleration(int i) const { return ToEigen(impl_->rate[i].v); }
Eigen::Vector3d Rod::force(int e) const { return ToEigen(impl_->chain.force(e)); }
Eigen::Vector3d Rod::moment(int e) const { return ToEigen(impl_->chain.moment(e)); }
Eigen::Vector3d Rod::curvature(int e) const { return ToEigen(impl_->chain.kappa(e)); }

// `rhs` of a held end keeps minus what is missing to its balance: the clamp supplies it.
Wrench Rod::reaction_a() const {
  const Vec6<Scalar>& b = impl_->rhs.front();
  const Eigen::Vector3d force(-b[0], -b[1], -b[2]), moment(-b[3], -b[4], -b[5]);
  return {force, ToEigen(impl_->node.front().q) * moment};
}
Wrench Rod::reaction_b() const {
  const Vec6<Scalar>& b = impl_->rhs.back();
  const Eigen::Vector3d force(-b[0], -b[1], -b[2]), moment(-b[3], -b[4], -b[5]);
  return {force, ToEigen(impl_->node.back().q) * moment};
}

double Rod::kinetic_energy() const {
  double energy = 0;
  for (int i = 0; i < impl_->count; ++i) {
    const NodeState& n = impl_->node[i];
    energy +=
        0.5 * (impl_->mass[i] * Dot(n.v, n.v) + Dot(n.omega, Scale(impl_->inertia[i], n.omega)));
  }
  return energy;
}
double Rod::elastic_energy() const { return impl_->StrainEnergy(); }
double Rod::gravity_energy() const { return impl_->GravityEnergy(impl_->node); }

}  // namespace cosserat_cable::rod
