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
Rod::Rod(const Rod& other) : Centreline(other) {
  other.impl_->Fetch();
  impl_ = std::make_unique<Impl>(*other.impl_);
}
Rod::Rod(Rod&&) noexcept = default;
Rod& Rod::operator=(Rod&&) noexcept = default;

const RodModel& Rod::model() const { return impl_->model; }
int Rod::elements() const { return impl_->model.elements; }

void Rod::SetSection(const Section& section) { impl_->SetSection(section); }

void Rod::SetConfiguration(const std::vector<Pose>& nodes) {
  Impl& m = *impl_;
  m.MoveOut();
  for (int i = 0; i < m.w.count; ++i) {
    NodeState& n = m.w.node[i];
    n = NodeState{ToSmall(nodes[i].p), Normalized(ToSmall(nodes[i].q)), V3{}, V3{}};
    if (i > 0 && Dot(n.q, m.w.node[i - 1].q) < 0) n.q = {-n.q.w, -n.q.x, -n.q.y, -n.q.z};
    m.w.rate[i] = m.w.algorithm[i] = m.w.mean[i] = NodeRates<double>{};
  }
  m.w.persistence = {};
  m.w.trial = m.w.node;
  m.PrepareStatics();
  m.laws.Reset();
  m.EvaluateStatics();
  m.ends.a.Start(Motion::Resting(nodes.front()));
  m.ends.b.Start(Motion::Resting(nodes.back()));
  m.TakeRest();
  m.ForgetHistory();
}

void Rod::SetClamps(const Pose& a, const Pose& b) {
  impl_->ends.a.Start(Motion::Resting(a));
  impl_->ends.b.Start(Motion::Resting(b));
}

void Rod::SetVelocities(const std::vector<Eigen::Vector3d>& v,
                        const std::vector<Eigen::Vector3d>& omega) {
  impl_->MoveOut();
  for (int i = impl_->first_free(); i <= impl_->last_free(); ++i) {
    impl_->w.node[i].v = ToSmall(v[i]);
    impl_->w.node[i].omega = ToSmall(omega[i]);
  }
}

void Rod::AddRigidMotion(const Motion& frame) {
  impl_->MoveOut();
  const Eigen::Matrix3d R = frame.X.q.toRotationMatrix();
  const Eigen::Vector3d omega = R * frame.omega, alpha = R * frame.alpha;
  const auto add = [&](const Pose& at, Motion* motion) {
    const Eigen::Vector3d d = at.p - frame.X.p;
    motion->v += frame.v + omega.cross(d);
    motion->a += frame.a + alpha.cross(d) + omega.cross(omega.cross(d));
    motion->omega += at.q.conjugate() * omega;
    motion->alpha += at.q.conjugate() * alpha;
  };
  for (int i = 0; i < impl_->w.count; ++i) {
    Motion added;
    add(pose(i), &added);
    NodeState& n = impl_->w.node[i];
    n.v += ToSmall(added.v);
    n.omega += ToSmall(added.omega);
    for (NodeRates<double>* rates :
         {&impl_->w.rate[i], &impl_->w.algorithm[i], &impl_->w.mean[i]}) {
      rates->v += ToSmall(added.a);
      rates->omega += ToSmall(added.alpha);
    }
  }
  impl_->w.persistence = {1, 1};
  for (EndPart* end : {&impl_->ends.a, &impl_->ends.b}) {
    Motion clamp = end->clamp();
    add(clamp.X, &clamp);
    end->Start(clamp);
  }
}

void Rod::SetMotion(const std::vector<Motion>& nodes, const Motion& a, const Motion& b) {
  Impl& m = *impl_;
  m.MoveOut();
  for (int i = 0; i < m.w.count; ++i) {
    m.w.node[i].v = ToSmall(nodes[i].v);
    m.w.node[i].omega = ToSmall(nodes[i].omega);
    m.w.rate[i] = m.w.algorithm[i] = m.w.mean[i] = {ToSmall(nodes[i].a), ToSmall(nodes[i].alpha)};
  }
  m.w.persistence = {1, 1};
  m.ends.a.Start(a);
  m.ends.b.Start(b);
  m.energy.Wait();  // while the forces are still those of statics
}

void Rod::SetTime(double time) { impl_->w.time = time; }
double Rod::time() const { return impl_->w.time; }
Motion Rod::clamp_a() const { return impl_->ends.a.clamp(); }

SolveReport Rod::Step(double dt, const Pose& a, const Pose& b, const Load* load) {
  Impl* m = impl_.get();
  if (!m->pair.stepper)
    m->pair.stepper =
        std::make_unique<ChainStepper<LanePair>>(ChainLayout::Halves(m->model.elements), *m);
  const RodDrive drive{&a, &b, load};
  SolveReport report;
  m->pair.stepper->Step(dt, 1, &m, &drive, &report);
  return report;
}

void Rod::Predict(double dt, const Pose& a, const Pose& b,
                  std::vector<Eigen::Vector3d>* positions) const {
  const Impl& m = *impl_;
  positions->resize(m.w.count);
  if (m.address.home)
    m.address.home->Predict(m.address.lane, dt, positions);
  else
    for (int i = 0; i < m.w.count; ++i)
      (*positions)[i] = ToEigen(m.w.node[i].r + dt * m.w.node[i].v);
  if (m.model.a.clamped()) positions->front() = a.p;
  if (m.model.b.clamped()) positions->back() = b.p;
}

NodeState Rod::NodeAt(int i) const {
  const RodAddress& address = impl_->address;
  return address.fetched ? impl_->w.node[i] : address.home->NodeAt(address.lane, i);
}
const ElementStress& Rod::StressAt(int e) const {
  impl_->Fetch();
  return impl_->Stress(e);
}
V3 Rod::position(int i) const { return NodeAt(i).r; }
V3 Rod::velocity(int i) const { return NodeAt(i).v; }
Quat<double> Rod::orientation(int i) const { return NodeAt(i).q; }
Pose Rod::pose(int i) const {
  const NodeState node = NodeAt(i);
  return {ToEigen(node.r), ToEigen(node.q)};
}
Pose Rod::pose_behind(int i) const {
  Pose seen = pose(i);
  if (!impl_->joints.empty()) seen.q = seen.q * ToEigen(impl_->joints[i]);
  return seen;
}
Eigen::Vector3d Rod::angular_velocity(int i) const { return ToEigen(NodeAt(i).omega); }
Eigen::Vector3d Rod::acceleration(int i) const {
  impl_->Fetch();
  return ToEigen(impl_->w.rate[i].v);
}
Eigen::Vector3d Rod::force(int e) const { return ToEigen(StressAt(e).n); }
Eigen::Vector3d Rod::moment(int e) const { return ToEigen(StressAt(e).m); }
Eigen::Vector3d Rod::curvature(int e) const { return ToEigen(StressAt(e).kappa); }

Wrench Rod::reaction_a() const {
  return ClampWrench(impl_->missing_a, ToEigen(impl_->w.node.front().q));
}
Wrench Rod::reaction_b() const {
  return ClampWrench(impl_->missing_b, ToEigen(impl_->w.node.back().q));
}

}  // namespace cosserat_cable::rod
