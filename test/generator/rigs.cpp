#include "rigs.h"

#include <cmath>
#include <stdexcept>

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
    return {rod.twist(state.q, station), rod.twist(state.v, station), rod.twist(state.a, station)};
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

/// Fills a record from the integrator's steps.
class Recorder {
 public:
  Recorder(const RodDynamics& rod, const Experiment& experiment, Record* record)
      : rod_(rod), experiment_(experiment), record_(record) {
    for (const Channel& channel : experiment.channels) {
      stations_.push_back(rod.shape().integralTo(channel.s));
    }
    record->values.resize(experiment.times.size(), experiment.channels.size());
  }

  void start(const MotionState& state) {
    for (size_t c = 0; c < stations_.size(); ++c) {
      const Channel& channel = experiment_.channels[c];
      right_.push_back(motionOf(rod_, channel, stations_[c], state));
      record_->values(0, c) = right_[c][derivativeOf(channel.quantity)];
    }
    next_ = 1;
  }

  void step(const MotionState& begin, const MotionState& end) {
    const std::vector<Vector3d> left = right_;
    for (size_t c = 0; c < stations_.size(); ++c) {
      right_[c] = motionOf(rod_, experiment_.channels[c], stations_[c], end);
    }
    for (; next_ < experiment_.times.size() && experiment_.times[next_] <= end.t; ++next_) {
      const double t = experiment_.times[next_] - begin.t;
      for (size_t c = 0; c < stations_.size(); ++c) {
        record_->values(next_, c) = hermite(left[c], right_[c], end.t - begin.t, t,
                                            derivativeOf(experiment_.channels[c].quantity));
      }
    }
  }

 private:
  const RodDynamics& rod_;
  const Experiment& experiment_;
  Record* record_;
  std::vector<Eigen::RowVectorXd> stations_;
  std::vector<Vector3d> right_;
  Eigen::Index next_ = 0;
};

}  // namespace

RodDynamics makeRig(const Experiment& experiment, const Resolution& resolution) {
  RodDynamics rod(makeRod(experiment.cable), resolution);
  const FrameMotion a = experiment.a;
  rod.clamp = [a](double) { return a; };
  rod.gravity = experiment.gravity;
  if (experiment.disc) rod.disc = *experiment.disc;
  if (experiment.guided) {
    EndHold guide;
    guide.pose = rod.clamp;
    guide.position[2] = guide.rotation[2] = false;
    rod.holds.push_back(guide);
  }
  return rod;
}

Record simulate(const Experiment& experiment, const Accuracy& accuracy) {
  RodDynamics rod = makeRig(experiment, accuracy.resolution);
  const VectorXd rest = loadedEquilibrium(rod);
  VectorXd released = rest;
  if (experiment.held) {
    released = heldEquilibrium(rod, rest, experiment.cable.length, *experiment.held);
    rod.forces.clear();
  } else {
    released = twistedEquilibrium(rod, rest, experiment.twisted);
    rod.end_torque = 0.0;
  }

  Record record;
  Recorder recorder(rod, experiment, &record);
  const VectorXd still = VectorXd::Zero(rod.size());
  recorder.start({0.0, released, still, accelerations(rod, 0.0, released, still)});
  RadauOptions options;
  options.tolerance = accuracy.tolerance * (released - rest).cwiseProduct(rod.scale()).norm() /
                      std::sqrt(static_cast<double>(rod.size()));
  record.counts = integrateRadau(
      rod, released, still, 0.0, experiment.times[experiment.times.size() - 1], options,
      [&](const MotionState& begin, const MotionState& end) { recorder.step(begin, end); });

  record.rest.resize(experiment.channels.size());
  for (size_t c = 0; c < experiment.channels.size(); ++c) {
    const Channel& channel = experiment.channels[c];
    record.rest[c] = motionOf(rod, channel, rod.shape().integralTo(channel.s),
                              atRest(rest))[derivativeOf(channel.quantity)];
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
