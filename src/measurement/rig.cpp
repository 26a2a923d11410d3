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
// How far, in rad, a disc's axis may lean from the one about which it is held; and tries.
constexpr double kUpright = 1e-8;
constexpr int kTwistTurns = 20;

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

/// An end that no clamp holds.
void LetGo(rod::EndModel* model) { *model = rod::EndModel::Free(); }

/// An end that a disc takes from its clamp; what acts about its axis stays.
void GiveToDisc(rod::EndModel* model) {
  const rod::EndModel held = *model;
  LetGo(model);
  model->damping.z() = held.damping.z();
  for (const auto& law : held.laws)
    if (law->InTorsionOnly()) model->laws.push_back(law);
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
  specimen_.cable.elements = elements;
  if (drift_ && !experiment.record.t.empty()) {
    const std::vector<double>& t = experiment.record.t;
    const auto& clock = experiment.quasi_static() ? std::nullopt : specimen.faults.clock;
    const std::vector<double> ends = MotionTimes({t.front(), t.back()}, clock);
    record_begin_ = ends.front();
    record_end_ = ends.back();
  }
  if (!experiment.load.samples.empty())
    now_.load = &load_.emplace(experiment.load, specimen.cable.length);
}

rod::RodModel Rig::Model(Turn b) const {
  rod::RodModel model = MakeRodModel(specimen_.cable, experiment_.gravity_W);
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
      GiveToDisc(&model.b);
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
  for (int i = 0; i <= elements_; ++i) nodes[i] = rod().pose(i);
  held.SetTime(rod().time());
  held.SetConfiguration(nodes);
  // Where the ends are along what lets them slide; turned as the clamps are.
  held.SetClamps({nodes.front().p, now_.a.X.q}, {nodes.back().p, now_.b.X.q});
  return held;
}

Pose Rig::TiltedA(const Pose& X_WC) const { return {X_WC.p, (X_WC.q * tilt_a_).normalized()}; }

Motion Rig::TiltedA(Motion motion) const {
  motion.X = TiltedA(motion.X);
  motion.omega = tilt_a_.conjugate() * motion.omega;
  motion.alpha = tilt_a_.conjugate() * motion.alpha;
  return motion;
}

bool Rig::SettleNear(const std::vector<Pose>& near, rod::Rod* rod) {
  if (near.size() < 2) return false;
  const std::vector<Pose> nodes = Resampled(near, elements_);
  rod->SetConfiguration(nodes);
  const Pose b = experiment_.b.kind == EndCondition::Kind::kClamp ? now_.b.X : nodes.back();
  rod->SetClamps(now_.a.X, b);
  if (!rod->EquilibrateNearby(load()).converged) return false;
  now_.b.X = b;
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
    rod->SetConfiguration(rod::BowedShape(now_.a.X, now_.b.X, specimen_.cable.length, elements_,
                                          experiment_.gravity_W));
  } else {
    // Unstressed about its axis: what the end is turned by counts from there.
    std::vector<Pose> straight = rod::StraightShape(now_.a.X, specimen_.cable.length, elements_);
    const double twist = rod->model().section.kappa0.z() * specimen_.cable.length;
    for (int i = 0; twist != 0 && i <= elements_; ++i)
      straight[i].q = straight[i].q * RotationExp(Vector3d(0, 0, twist * i / elements_));
    rod->SetConfiguration(straight);
    now_.b.X = rod->pose(elements_);
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
  now_.a = TiltedA(statics ? Motion::Resting(path_a_->AtStep(0)) : path_a_->At(t));
  now_.b = statics ? Motion::Resting(path_b_->AtStep(0)) : path_b_->At(t);

  // End b is held about its axis until it is let go.
  const bool twisted = start.kind == StartCondition::Kind::kTwisted;
  rod::RodModel at_rest = Model(twisted ? Turn::kHeld : Turn::kFree);
  // Where nothing says how the sections are turned about the axis, clamp a's do: rests that are
  // found apart, at other numbers of elements, are then one.
  if (!at_rest.b.rotation[2]) at_rest.a.rotation[2] = true;
  rod::Rod settling(at_rest);
  settling.SetTime(t);
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
      Eigen::Quaterniond disc = (rest.q * RotationExp(Vector3d(0, 0, angle))).normalized();
      // It is turned about its own axis, which leans where the section couples bending to twist.
      for (int turn = 0; turn < kTwistTurns; ++turn) {
        settling.SetClamps(now_.a.X, {rest.p, disc});
        if (!settling.Equilibrate(load()).converged) {
          *message = "no static equilibrium found with the disc held at its angle";
          return false;
        }
        const Eigen::Quaterniond leaning = settling.pose(elements_).q;
        const bool upright = disc.angularDistance(leaning) < kUpright;
        disc = leaning;
        if (upright) break;
      }
    }
  }

  std::vector<Pose> nodes(elements_ + 1);
  for (int i = 0; i <= elements_; ++i) nodes[i] = settling.pose(i);
  const bool swings = !specimen_.swing.rotation.empty();
  const rod::RodModel model = Model(Turn::kFree);
  const Eigen::Matrix3d R_b = now_.b.X.q.toRotationMatrix();
  Vector3d along;
  for (int k = 0; k < 3; ++k) along[k] = model.b.translation[k];
  const SwungShape swung(nodes, specimen_.cable.length, specimen_.swing,
                         R_b * along.asDiagonal() * R_b.transpose());
  if (swings) nodes = swung.Nodes();
  if (experiment_.b.kind != EndCondition::Kind::kClamp) now_.b.X = nodes.back();
  first_section_ = model.section;
  rod::Rod rod(model);
  rod.SetTime(t);
  rod.SetConfiguration(nodes);
  rod.SetClamps(now_.a.X, now_.b.X);
  if (swings) {
    std::vector<Vector3d> v, omega;
    swung.Velocities(&v, &omega);
    rod.SetVelocities(v, omega);
  }
  if (path_a_->moves() && !statics) rod.AddRigidMotion(now_.a);
  if (statics)
    rod_.emplace(std::move(rod));
  else
    cable_ = std::make_unique<CableSimulation>(specimen_.cable, std::move(rod), now_);
  return true;
}

const rod::Section* Rig::DriftedTo(double t) {
  if (!drift_ || !(record_end_ > record_begin_)) return nullptr;
  const double part = std::clamp((t - record_begin_) / (record_end_ - record_begin_), 0.0, 1.0);
  section_ = Drifted(first_section_, *drift_, part);
  return &section_;
}

const Surroundings& Rig::At(double t) {
  if (path_a_->moves()) now_.a = TiltedA(path_a_->At(t));
  if (path_b_->moves()) now_.b = path_b_->At(t);
  now_.section = DriftedTo(t);
  return now_;
}

bool Rig::Equilibrate(int step, std::string* message) {
  now_.a.X = TiltedA(path_a_->AtStep(step));
  if (path_b_->moves()) now_.b.X = path_b_->AtStep(step);
  if (const rod::Section* section = DriftedTo(step)) rod_->SetSection(*section);
  rod_->SetTime(step);
  rod_->SetClamps(now_.a.X, now_.b.X);
  // Slowly from step to step: what a friction carries at one is where the next begins.
  if (rod_->EquilibrateWithHistory(load()).converged) return true;
  *message = "no static equilibrium found at step " + std::to_string(step);
  return false;
}

}  // namespace cosserat_cable
