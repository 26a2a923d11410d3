#include "rig.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/cable/cable_rod.h"
#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/rod/initial_shape.h"
#include "pull.h"
#include "record_clock.h"
#include "swung_shape.h"

namespace cosserat_cable {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// A disc is turned to its start in parts of this [rad], so that no element turns too far at once.
constexpr double kTwistStride = 0.5;

// `near` picks one of several equilibria: to be about there, of the length, is enough.
constexpr double kNear = 1e-3;

/// What a clamp lets go.
void Release(const EndCondition& end, rod::EndModel* model) {
  for (int k = 0; k < 3; ++k) {
    if (end.translation_free[k]) model->translation[k] = false;
    if (end.rotation_free[k]) model->rotation[k] = false;
  }
  if (end.roll_unknown) model->rotation[2] = false;
}

/// An end that no clamp holds; a dashpot about the axis stays (the disc's D_E).
void LetGo(rod::EndModel* model) {
  const double D_E = model->damping.z();
  *model = rod::EndModel::Free();
  model->damping.z() = D_E;
}

/// The shape at another number of nodes, evenly spread.
std::vector<Pose> Resampled(const std::vector<Pose>& shape, int elements) {
  const auto last = static_cast<int>(shape.size()) - 1;
  if (last == elements) return shape;
  std::vector<Pose> nodes;
  for (int i = 0; i <= elements; ++i) {
    const double x = static_cast<double>(i) * last / elements;
    const int k = std::min(static_cast<int>(x), last - 1);
    const Pose &left = shape[static_cast<std::size_t>(k)],
               &right = shape[static_cast<std::size_t>(k) + 1];
    nodes.push_back({left.p + (x - k) * (right.p - left.p), left.q.slerp(x - k, right.q)});
  }
  return nodes;
}

}  // namespace

Rig::Rig(const Experiment& experiment, const Specimen& specimen, int elements, RigPaths* paths)
    : experiment_(experiment),
      specimen_(specimen),
      elements_(elements),
      path_a_(paths->a.With(specimen.faults.a)),
      path_b_(paths->b.With(specimen.faults.b)),
      tilt_a_(RotationExp(specimen.tilt_a)),
      drift_(DriftOf(specimen.cable)) {
  if (drift_ && !experiment.record.t.empty()) {
    const std::vector<double>& t = experiment.record.t;
    const auto& clock = experiment.quasi_static() ? std::nullopt : specimen.faults.clock;
    const std::vector<double> ends = MotionTimes({t.front(), t.back()}, clock);
    record_begin_ = ends.front();
    record_end_ = ends.back();
  }
  if (!experiment.load.samples.empty()) {
    SetLoads(experiment.start_time());
  }
}

rod::RodModel Rig::Model(Turn b) const {
  rod::RodModel model = MakeRodModel(specimen_.cable, experiment_.gravity_W);
  model.elements = elements_;
  Release(experiment_.a, &model.a);
  switch (experiment_.b.kind) {
    case EndCondition::Kind::kClamp:
      Release(experiment_.b, &model.b);
      break;
    case EndCondition::Kind::kFree:
      LetGo(&model.b);
      break;
    case EndCondition::Kind::kDisc: {
      const double J = specimen_.disc_inertia;
      model.bodies.push_back(
          {specimen_.cable.length, experiment_.b.disc.mass, Vector3d(0.5 * J, 0.5 * J, J)});
      LetGo(&model.b);
      if (experiment_.b.disc.guided) {
        model.b.translation = {true, true, false};
        model.b.rotation = {true, true, false};
      }
      break;
    }
  }
  if (b == Turn::kHeld) model.b.rotation[2] = true;
  return model;
}

rod::Rod Rig::WithSlidesHeld() const {
  rod::RodModel model = Model(Turn::kFree);
  for (rod::EndModel* end : {&model.a, &model.b})
    if (end->translation != std::array{false, false, false}) end->translation = {true, true, true};
  rod::Rod held(model);
  std::vector<Pose> nodes(elements_ + 1);
  for (int i = 0; i <= elements_; ++i) nodes[i] = rod_->pose(i);
  held.SetConfiguration(nodes);
  // Where the ends are along what lets them slide; turned as the clamps are.
  held.SetClamps({nodes.front().p, a_.q}, {nodes.back().p, b_.q});
  return held;
}

Pose Rig::TiltedA(const Pose& X_WC) const { return {X_WC.p, (X_WC.q * tilt_a_).normalized()}; }

void Rig::SetLoads(double t) {
  const ExperimentLoad& load = experiment_.load;
  std::vector<rod::PointLoad> now;
  if (load.file.empty()) {
    for (const ExperimentLoad::Sample& sample : load.samples)
      now.push_back({sample.s, sample.force_W, Vector3d::Zero(), false});
  } else {
    // Samples of one time are forces at several points: the i-th goes over into the i-th.
    const auto after = std::upper_bound(
        load.samples.begin(), load.samples.end(), t,
        [](double time, const ExperimentLoad::Sample& sample) { return time < sample.t; });
    const auto first_at = [&](double time) {
      return std::lower_bound(
          load.samples.begin(), load.samples.end(), time,
          [](const ExperimentLoad::Sample& sample, double limit) { return sample.t < limit; });
    };
    auto left = after == load.samples.begin() ? after : first_at((after - 1)->t);
    auto right = after == load.samples.end() ? left : after;
    const double from = left->t, to = right->t;
    const double x = to > from ? std::clamp((t - from) / (to - from), 0.0, 1.0) : 0.0;
    for (; left != load.samples.end() && left->t == from; ++left) {
      const bool paired = right != load.samples.end() && right->t == to;
      const ExperimentLoad::Sample& next = paired ? *right++ : *left;
      now.push_back({left->s + x * (next.s - left->s),
                     left->force_W + x * (next.force_W - left->force_W), Vector3d::Zero(), false});
    }
  }
  if (loads_)
    loads_->loads = std::move(now);
  else
    loads_.emplace(specimen_.cable.length, std::move(now));
}

bool Rig::SettleNear(const std::vector<Pose>& near, rod::Rod* rod) {
  if (near.size() < 2) return false;
  const std::vector<Pose> nodes = Resampled(near, elements_);
  rod->SetConfiguration(nodes);
  const Pose b = experiment_.b.kind == EndCondition::Kind::kClamp ? b_ : nodes.back();
  rod->SetClamps(a_, b);
  if (!rod->EquilibrateNearby(load()).converged) return false;
  b_ = b;
  return true;
}

bool Rig::Settle(const std::vector<Pose>* near_rest, rod::Rod* rod, std::string* message) {
  if (near_rest && SettleNear(*near_rest, rod)) return true;
  const auto equilibrate = [&] {
    if (rod->Equilibrate(load()).converged) return true;
    *message = "no static equilibrium found at the start";
    return false;
  };
  const EndCondition& b = experiment_.b;
  if (b.kind == EndCondition::Kind::kClamp) {
    rod->SetConfiguration(
        rod::BowedShape(a_, b_, specimen_.cable.length, elements_, experiment_.gravity_W));
  } else {
    // Unstressed about its axis: what the end is turned by counts from there.
    std::vector<Pose> straight = rod::StraightShape(a_, specimen_.cable.length, elements_);
    const double twist = rod->model().section.kappa0.z() * specimen_.cable.length;
    for (int i = 0; twist != 0 && i <= elements_; ++i)
      straight[i].q = straight[i].q * RotationExp(Vector3d(0, 0, twist * i / elements_));
    rod->SetConfiguration(straight);
    b_ = rod->pose(elements_);
  }
  if (!equilibrate()) return false;
  if (const auto& near = experiment_.start.near) {
    if (!PullTo(*near, kNear, rod)) {
      *message = "the cable cannot be brought near the position that start.near asks for";
      return false;
    }
    if (!equilibrate()) return false;
  }
  return true;
}

bool Rig::Start(std::string* message, const std::vector<Pose>* near) {
  const double t = experiment_.start_time();
  const bool statics = experiment_.quasi_static();
  const StartCondition& start = experiment_.start;
  a_ = TiltedA(statics ? path_a_->AtStep(0) : path_a_->At(t).X);
  b_ = statics ? path_b_->AtStep(0) : path_b_->At(t).X;
  if (!experiment_.load.samples.empty()) SetLoads(t);

  // End b is held about its axis until it is let go.
  const bool twisted = start.kind == StartCondition::Kind::kTwisted;
  rod::RodModel at_rest = Model(twisted ? Turn::kHeld : Turn::kFree);
  // Where nothing says how the sections are turned about the axis, clamp a's do: rests that are
  // found apart, at other numbers of elements, are then one.
  if (!at_rest.b.rotation[2]) at_rest.a.rotation[2] = true;
  rod::Rod settling(at_rest);
  // An end that is held about its axis is held where this cable has it, not a cable like it.
  if (!Settle(twisted ? nullptr : near, &settling, message)) return false;
  rest_.resize(elements_ + 1);
  for (int i = 0; i <= elements_; ++i) rest_[i] = settling.pose(i);
  if (start.kind == StartCondition::Kind::kHeld && !PullTo(start.held, kThere, &settling)) {
    *message = "the cable cannot be pulled to the position that start.held asks for";
    return false;
  }
  if (twisted) {
    const Pose rest = settling.pose(elements_);
    const int strides =
        std::max(1, static_cast<int>(std::ceil(std::abs(start.twisted) / kTwistStride)));
    for (int k = 1; k <= strides; ++k) {
      const double angle = start.twisted * k / strides;
      settling.SetClamps(a_, {rest.p, rest.q * RotationExp(Vector3d(0, 0, angle)).normalized()});
      if (!settling.Equilibrate(load()).converged) {
        *message = "no static equilibrium found with the disc held at its angle";
        return false;
      }
    }
  }

  std::vector<Pose> nodes(elements_ + 1);
  for (int i = 0; i <= elements_; ++i) nodes[i] = settling.pose(i);
  const bool swings = !specimen_.swing.rotation.empty();
  const rod::RodModel model = Model(Turn::kFree);
  const Eigen::Matrix3d R_b = b_.q.toRotationMatrix();
  Vector3d along;
  for (int k = 0; k < 3; ++k) along[k] = model.b.translation[k];
  const SwungShape swung(nodes, specimen_.cable.length, specimen_.swing,
                         R_b * along.asDiagonal() * R_b.transpose());
  if (swings) nodes = swung.Nodes();
  if (experiment_.b.kind != EndCondition::Kind::kClamp) b_ = nodes.back();
  section_ = model.section;
  rod_ = std::make_unique<rod::Rod>(model);
  rod_->SetTime(t);
  rod_->SetConfiguration(nodes);
  rod_->SetClamps(a_, b_);
  if (swings) {
    std::vector<Vector3d> v, omega;
    swung.Velocities(&v, &omega);
    rod_->SetVelocities(v, omega);
  }
  if (!statics && path_a_->moves()) {
    Motion motion = path_a_->At(t);
    motion.X = a_;
    rod_->AddRigidMotion(motion);
  }
  return true;
}

void Rig::ApplyDrift(double t) {
  if (!drift_ || !(record_end_ > record_begin_)) return;
  const double part = std::clamp((t - record_begin_) / (record_end_ - record_begin_), 0.0, 1.0);
  rod_->SetSection(Drifted(section_, *drift_, part));
}

void Rig::MoveTo(double t) {
  ApplyDrift(t);
  if (path_a_->moves()) a_ = TiltedA(path_a_->At(t).X);
  if (path_b_->moves()) b_ = path_b_->At(t).X;
  if (!experiment_.load.file.empty()) SetLoads(t);
}

bool Rig::Equilibrate(int step, std::string* message) {
  a_ = TiltedA(path_a_->AtStep(step));
  if (path_b_->moves()) b_ = path_b_->AtStep(step);
  if (!experiment_.load.file.empty()) SetLoads(step);
  ApplyDrift(step);
  rod_->SetClamps(a_, b_);
  // Slowly from step to step: what a friction carries at one is where the next begins.
  if (rod_->EquilibrateWithHistory(load()).converged) return true;
  *message = "no static equilibrium found at step " + std::to_string(step);
  return false;
}

}  // namespace cosserat_cable
