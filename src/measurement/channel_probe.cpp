#include "channel_probe.h"

#include <algorithm>

#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/math/small_eigen.h"
#include "pull.h"

namespace cosserat_cable {
namespace {

bool ShowsPoint(Quantity quantity) {
  return quantity == Quantity::kPosition || quantity == Quantity::kVelocity ||
         quantity == Quantity::kAcceleration;
}

}  // namespace

ChannelProbe::ChannelProbe(const std::vector<Channel>& channels,
                           const std::vector<ChannelSensor>& sensors)
    : channels_(channels), sensors_(sensors), place_of_(channels.size()) {
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (!ShowsPoint(channels[c].quantity)) continue;
    const auto known = std::find(places_.begin(), places_.end(), channels[c].s);
    place_of_[c] = static_cast<std::size_t>(known - places_.begin());
    if (known == places_.end()) places_.push_back(channels[c].s);
  }
  points_.resize(places_.size());
}

int ChannelProbe::DerivativeOrder(Quantity quantity) {
  switch (quantity) {
    case Quantity::kVelocity:
    case Quantity::kRate:
      return 1;
    case Quantity::kAcceleration:
      return 2;
    default:
      return 0;
  }
}

double ChannelProbe::Angle(const Rig& rig, double s) {
  const rod::Rod& rod = rig.rod();
  if (twist_.empty()) {
    twist_.resize(rod.elements() + 1);
    Eigen::Quaterniond q = ToEigen(rod.orientation(0));
    // What clamp a lets the section turn is part of the angle.
    twist_[0] = RotationLog(rig.clamp_a().q.conjugate() * q).z();
    for (int e = 0; e < rod.elements(); ++e) {
      const Eigen::Quaterniond next = ToEigen(rod.orientation(e + 1));
      twist_[e + 1] = twist_[e] + RotationLog(q.conjugate() * next).z();
      q = next;
    }
  }
  const double x = s / rod.model().length * rod.elements();
  const int e = std::clamp(static_cast<int>(x), 0, rod.elements() - 1);
  const double relative = twist_[e] + (x - e) * (twist_[e + 1] - twist_[e]);
  return relative - rod.model().section.kappa0.z() * s;
}

void ChannelProbe::Sample(const Rig& rig, Eigen::Ref<Eigen::VectorXd> values) {
  twist_.clear();
  const rod::Rod& rod = rig.rod();
  const Pose& a = rig.clamp_a();
  for (std::size_t k = 0; k < places_.size(); ++k) points_[k] = PointOn(rod, places_[k]);
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const Channel& channel = channels_[c];
    const auto component = [&](const Eigen::Vector3d& v_W) {
      if (const auto& direction = sensors_[c].direction)
        return direction->dot(channel.in_frame_a ? a.q.conjugate() * v_W : v_W);
      return channel.in_frame_a ? (a.q.conjugate() * v_W)[channel.axis] : v_W[channel.axis];
    };
    switch (channel.quantity) {
      case Quantity::kPosition:
      case Quantity::kVelocity:
      case Quantity::kAcceleration: {
        const Eigen::Vector3d& p = points_[place_of_[c]];
        values[c] = component(channel.in_frame_a ? Eigen::Vector3d(p - a.p) : p);
        break;
      }
      case Quantity::kAngle:
      case Quantity::kRate:
        values[c] = Angle(rig, channel.s);
        break;
      case Quantity::kForce:
      case Quantity::kMoment: {
        const rod::Wrench wrench =
            channel.clamp == ClampSide::kA ? rod.reaction_a() : rod.reaction_b();
        values[c] = component(channel.quantity == Quantity::kForce ? wrench.force : wrench.moment);
        break;
      }
    }
  }
}

}  // namespace cosserat_cable
