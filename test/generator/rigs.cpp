#include "rigs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "effects/kinds.h"
#include "statics.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

MotionState atRest(const VectorXd& q) {
  return {0.0, q, VectorXd::Zero(q.size()), VectorXd::Zero(q.size())};
}

/// Value and two derivatives by time of what a channel's quantity derives from: a coordinate of a
/// point, or the twist.
Vector3d motionOf(const RodDynamics& rod, const Channel& channel, const Eigen::RowVectorXd& station,
                  const MotionState& state) {
  if (channel.quantity >= Channel::Quantity::kAngle) {
    return {rod.twist(state.q, station) - rod.unstressedTwist() * channel.s,
            rod.twist(state.v, station), rod.twist(state.a, station)};
  }
  const PointMotion m = rod.pointMotion(state, station);
  return {m.position[channel.axis], m.velocity[channel.axis], m.acceleration[channel.axis]};
}

int derivativeOf(Channel::Quantity quantity) {
  switch (quantity) {
    case Channel::Quantity::kPosition:
    case Channel::Quantity::kAngle:
      return 0;
    case Channel::Quantity::kVelocity:
    case Channel::Quantity::kRate:
      return 1;
    case Channel::Quantity::kAcceleration:
      return 2;
  }
  throw std::logic_error("unknown quantity");
}

/// The quintic that has value and two derivatives given at 0 and h, or one of its derivatives.
double hermite(const Vector3d& left, const Vector3d& right, double h, double t, int derivative) {
  const double c0 = left[0], c1 = left[1] * h, c2 = 0.5 * left[2] * h * h;
  const double d0 = right[0] - c0 - c1 - c2;
  const double d1 = right[1] * h - c1 - 2.0 * c2;
  const double d2 = right[2] * h * h - 2.0 * c2;
  const double c3 = 10.0 * d0 - 4.0 * d1 + 0.5 * d2;
  const double c4 = -15.0 * d0 + 7.0 * d1 - d2;
  const double c5 = 6.0 * d0 - 3.0 * d1 + 0.5 * d2;
  const double x = t / h;
  if (derivative == 0) return c0 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * c5))));
  if (derivative == 1) {
    return (c1 + x * (2.0 * c2 + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)))) / h;
  }
  return (2.0 * c2 + x * (6.0 * c3 + x * (12.0 * c4 + x * 20.0 * c5))) / (h * h);
}

/// Fills a record from the integrator's steps. Times up to 0 show the start.
class Recorder {
 public:
  Recorder(const RodDynamics& rod, std::vector<Channel> channels, VectorXd times,
           Eigen::MatrixXd* values)
      : rod_(rod), channels_(std::move(channels)), times_(std::move(times)), values_(values) {
    for (const Channel& channel : channels_) {
      stations_.push_back(rod.shape().integralTo(channel.s));
    }
    values->resize(times_.size(), channels_.size());
  }

  void start(const MotionState& state) {
    for (size_t c = 0; c < stations_.size(); ++c) {
      right_.push_back(motionOf(rod_, channels_[c], stations_[c], state));
    }
    for (; next_ < times_.size() && times_[next_] <= 0.0; ++next_) {
      for (size_t c = 0; c < stations_.size(); ++c) {
        (*values_)(next_, c) = right_[c][derivativeOf(channels_[c].quantity)];
      }
    }
  }

  void step(const MotionState& begin, const MotionState& end) {
    const std::vector<Vector3d> left = right_;
    for (size_t c = 0; c < stations_.size(); ++c) {
      right_[c] = motionOf(rod_, channels_[c], stations_[c], end);
    }
    for (; next_ < times_.size() && times_[next_] <= end.t; ++next_) {
      const double t = times_[next_] - begin.t;
      for (size_t c = 0; c < stations_.size(); ++c) {
        (*values_)(next_, c) =
            hermite(left[c], right_[c], end.t - begin.t, t, derivativeOf(channels_[c].quantity));
      }
    }
  }

 private:
  const RodDynamics& rod_;
  std::vector<Channel> channels_;
  VectorXd times_;
  Eigen::MatrixXd* values_;
  std::vector<Eigen::RowVectorXd> stations_;
  std::vector<Vector3d> right_;
  Eigen::Index next_ = 0;
};

/// What the channels show at rest.
Eigen::RowVectorXd shownAt(const RodDynamics& rod, const std::vector<Channel>& channels,
                           const VectorXd& q, double t = 0.0) {
  Eigen::RowVectorXd values(channels.size());
  MotionState state = atRest(q);
  state.t = t;
  for (size_t c = 0; c < channels.size(); ++c) {
    values[c] = motionOf(rod, channels[c], rod.shape().integralTo(channels[c].s),
                         state)[derivativeOf(channels[c].quantity)];
  }
  return values;
}

/// What a sensor makes of its channels: needs all axes of a vector and dense samples.
class SensorStage {
 public:
  SensorStage(std::vector<std::shared_ptr<Effect>> effects, const std::vector<Channel>& channels)
      : effects_(std::move(effects)), channels_(channels) {
    for (const Channel& channel : channels) {
      const bool scalar = channel.quantity >= Channel::Quantity::kAngle;
      for (int axis = 0; axis < (scalar ? 1 : 3); ++axis) {
        true_.push_back(channel);
        if (!scalar) true_.back().axis = axis;
      }
    }
  }
  const std::vector<Channel>& trueChannels() const { return true_; }

  Eigen::MatrixXd sense(double dt, Eigen::MatrixXd dense) const {
    Eigen::MatrixXd result(dense.rows(), channels_.size());
    int column = 0;
    for (size_t c = 0; c < channels_.size(); ++c) {
      const bool scalar = channels_[c].quantity >= Channel::Quantity::kAngle;
      const int count = scalar ? 1 : 3;
      for (const auto& effect : effects_) effect->sense(dt, dense.middleCols(column, count));
      result.col(c) = dense.col(column + (scalar ? 0 : channels_[c].axis));
      column += count;
    }
    return result;
  }

 private:
  std::vector<std::shared_ptr<Effect>> effects_;
  std::vector<Channel> channels_, true_;
};

/// Effects, clamps and times of an experiment as they really are.
struct TrueRig {
  std::vector<std::shared_ptr<Effect>> effects;
  FrameCurve a, b;

  explicit TrueRig(const Experiment& e) {
    EffectSite site;
    site.cable = e.cable;
    site.duration = e.times.size() > 0 ? e.times[e.times.size() - 1] : 1.0;
    site.disc = e.disc.has_value();
    effects = makeEffects(e.effects, site);
    const FrameMotion start = e.a;
    a = [start](double) { return start; };
    if (e.drive) a = excite(*e.drive);
    if (e.b) {
      const FrameMotion end = *e.b;
      b = [end](double) { return end; };
    }
    for (const auto& effect : effects) {
      a = effect->clampMotion(0, a, site.duration, e.drive.has_value());
      if (b) b = effect->clampMotion(1, b, site.duration, false);
    }
  }
  double motionTime(double t) const {
    for (const auto& effect : effects) t = effect->motionTime(t);
    return t;
  }
  bool senses() const {
    return std::any_of(effects.begin(), effects.end(), [](const auto& e) { return e->senses(); });
  }
};

RodDynamics assembled(const Experiment& experiment, const TrueRig& rig,
                      const Resolution& resolution) {
  CableData cable = experiment.cable;
  for (const auto& effect : rig.effects) effect->equip(&cable);
  RodDynamics rod(makeRod(cable), resolution);
  rod.clamp = rig.a;
  rod.gravity = experiment.gravity;
  if (experiment.disc) rod.disc = *experiment.disc;
  if (experiment.guided) {
    EndHold guide;
    guide.pose = rod.clamp;
    guide.position[2] = guide.rotation[2] = false;
    rod.holds.push_back(guide);
  }
  if (rig.b) {
    EndHold hold;
    hold.pose = rig.b;
    rod.holds.push_back(hold);
  }
  for (const auto& effect : rig.effects) rod.addEffect(effect);
  return rod;
}

/// From straight to where clamp b holds the end, along arcs of growing curvature.
VectorXd archRest(RodDynamics* rod) {
  constexpr int kArcs = 24;
  const FrameMotion a = rod->clamp(0.0);
  const FrameCurve held = rod->holds.front().pose;
  const FrameMotion b = held(0.0);
  const Eigen::Matrix3d R = a.R.transpose() * b.R;
  const Vector3d place = a.R.transpose() * (b.p - a.p);
  Eigen::AngleAxisd turn(R);
  if (turn.axis().cross(Vector3d::UnitZ()).dot(place) < 0.0) {
    // Half a turn has two axes; the arc has to lead to where the end is.
    turn = Eigen::AngleAxisd(2.0 * std::acos(-1.0) - turn.angle(), -turn.axis());
  }
  const double L = rod->rod().length;
  const auto arc = [&](double part) -> Vector3d {  // its end in clamp a's frame
    const double angle = part * turn.angle();
    if (angle == 0.0) return L * Vector3d::UnitZ();
    const Vector3d side = turn.axis().cross(Vector3d::UnitZ());
    return L / angle * (std::sin(angle) * Vector3d::UnitZ() + (1.0 - std::cos(angle)) * side);
  };
  const Vector3d beside = place - arc(1.0);
  VectorXd q = VectorXd::Zero(rod->size()), before = q;
  for (int stage = 0; stage <= kArcs; ++stage) {
    const double part = static_cast<double>(stage) / kArcs;
    FrameMotion pose = b;
    pose.p = a.p + a.R * (arc(part) + part * beside);
    pose.R = a.R * Eigen::AngleAxisd(part * turn.angle(), turn.axis()).toRotationMatrix();
    rod->holds.front().pose = [pose](double) { return pose; };
    // Stiff holds leave Newton's method no way but near the answer: the next arc, then the trend.
    VectorXd guess = q;
    if (stage == 1) {
      const Vector3d K = turn.angle() / L / kArcs * turn.axis();
      for (int c = 0; c < 3; ++c) guess[rod->shape().offset(c)] += K[c];
    } else if (stage > 1) {
      guess += q - before;
    }
    before = q;
    q = equilibrium(*rod, guess);
    remember(*rod, q);
  }
  rod->holds.front().pose = held;
  return equilibrium(*rod, q);
}

/// A record of equilibria under forces at the tip, each reached in some smaller steps.
Record bend(const Experiment& experiment, RodDynamics* rod) {
  constexpr int kBetween = 4;
  const VectorXd rest = loadedEquilibrium(*rod);
  const double L = experiment.cable.length;
  VectorXd q = rest;
  Vector3d force = Vector3d::Zero();
  Record record;
  record.values.resize(experiment.tip_forces.size(), experiment.channels.size());
  for (size_t i = 0; i < experiment.tip_forces.size(); ++i) {
    for (int k = 1; k <= kBetween; ++k) {
      const Vector3d next =
          force + static_cast<double>(k) / kBetween * (experiment.tip_forces[i] - force);
      rod->forces = {{L, next}};
      q = equilibrium(*rod, q);
      remember(*rod, q);
    }
    force = experiment.tip_forces[i];
    record.values.row(i) = shownAt(*rod, experiment.channels, q);
  }
  record.rest = shownAt(*rod, experiment.channels, rest).transpose();
  return record;
}

}  // namespace

RodDynamics makeRig(const Experiment& experiment, const Resolution& resolution) {
  return assembled(experiment, TrueRig(experiment), resolution);
}

VectorXd restOf(const Experiment& experiment, RodDynamics* rod) {
  return experiment.b ? archRest(rod) : loadedEquilibrium(*rod);
}

Record simulate(const Experiment& experiment, const Accuracy& accuracy) {
  // Kinks cost many steps, and the noise hides what coarser ones cost; tested.
  constexpr double kAbruptTolerance = 30.0;
  constexpr double kSamplesPerStep = 4.0;  // of a sensor's dense samples
  constexpr double kDrivenScale = 0.5;     // strains over displacement, in lengths
  const TrueRig rig(experiment);
  RodDynamics rod = assembled(experiment, rig, accuracy.resolution);
  if (!experiment.tip_forces.empty()) {
    Record record = bend(experiment, &rod);
    if (rig.senses()) {
      // Slow: no low pass shows.
      const SensorStage sensor(rig.effects, experiment.channels);
      Experiment whole = experiment;
      whole.channels = sensor.trueChannels();
      RodDynamics again = assembled(whole, TrueRig(whole), accuracy.resolution);
      const Record all = bend(whole, &again);
      record.values = sensor.sense(1e9, all.values);
      record.rest = sensor.sense(1.0, all.rest.transpose()).transpose();
    }
    return record;
  }

  const VectorXd rest = restOf(experiment, &rod);
  VectorXd released = rest;
  double size = 0.0;
  if (experiment.held) {
    released = heldEquilibrium(rod, rest, experiment.cable.length, *experiment.held);
    rod.forces.clear();
  } else if (experiment.disc) {
    released = twistedEquilibrium(rod, rest, experiment.twisted);
    rod.end_torque = 0.0;
  }
  size = (released - rest).cwiseProduct(rod.scale()).norm() /
         std::sqrt(static_cast<double>(rod.size()));
  if (experiment.drive) {
    size = std::max(
        size, kDrivenScale * largestDisplacement(*experiment.drive) / experiment.cable.length);
  }

  // Times of the motion; dense ones where a sensor looks between the samples.
  const SensorStage sensor(rig.effects, experiment.channels);
  const Eigen::Index count = experiment.times.size();
  VectorXd moments = experiment.times;
  std::vector<Channel> channels = experiment.channels;
  double dt = 0.0;
  if (rig.senses()) {
    const double end = experiment.times[count - 1];
    const int dense = static_cast<int>(kSamplesPerStep * std::max<double>(count, 2000.0 * end));
    dt = end / dense;
    moments = VectorXd::LinSpaced(dense + 1, 0.0, end);
    channels = sensor.trueChannels();
  }
  for (double& t : moments) t = rig.motionTime(t);

  Record record;
  Recorder recorder(rod, channels, moments, &record.values);
  const VectorXd still = VectorXd::Zero(rod.size());
  recorder.start({0.0, released, still, accelerations(rod, 0.0, released, still)});
  RadauOptions options;
  options.tolerance = accuracy.tolerance * size * (rod.abrupt() ? kAbruptTolerance : 1.0);
  record.counts = integrateRadau(rod, released, still, 0.0, moments[moments.size() - 1], options,
                                 [&](const MotionState& begin, const MotionState& end) {
                                   if (rod.hasEffects()) rod.commit(end);
                                   recorder.step(begin, end);
                                 });

  record.rest = shownAt(rod, channels, rest).transpose();
  if (rig.senses()) {
    record.rest = sensor.sense(1.0, record.rest.transpose()).transpose();
    const Eigen::MatrixXd dense = sensor.sense(dt, record.values);
    record.values.resize(count, dense.cols());
    for (Eigen::Index i = 0; i < count; ++i) {
      const double x = experiment.times[i] / dt;
      const Eigen::Index k = std::min<Eigen::Index>(static_cast<Eigen::Index>(x), dense.rows() - 2);
      record.values.row(i) = dense.row(k) + (x - k) * (dense.row(k + 1) - dense.row(k));
    }
  }
  return record;
}

Vector3d pulledEnd(const Experiment& experiment, const Vector3d& direction, double distance) {
  constexpr double kCloseEnough = 0.03;  // of the distance
  constexpr int kMaxTries = 40;
  RodDynamics rod = makeRig(experiment, Resolution());
  const double L = experiment.cable.length;
  const Eigen::RowVectorXd end = rod.shape().integralTo(L);
  VectorXd q = loadedEquilibrium(rod);
  const Vector3d rest = rod.pointMotion(atRest(q), end).position;
  double force = 3.0 * experiment.cable.EI / (L * L * L) * distance;
  for (int attempt = 0; attempt < kMaxTries; ++attempt) {
    rod.forces = {{L, force * direction.normalized()}};
    q = equilibrium(rod, q);
    const Vector3d position = rod.pointMotion(atRest(q), end).position;
    const double moved = (position - rest).norm();
    if (std::abs(moved - distance) < kCloseEnough * distance) return position;
    force *= distance / moved;
  }
  throw std::runtime_error("no force pulls the end that far");
}

}  // namespace cosserat_cable::generator
