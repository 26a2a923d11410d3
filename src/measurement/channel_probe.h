// What a rig's channels show at an instant.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cosserat_cable/measurement/measurement_set.h"
#include "rig.h"
#include "sensor.h"

namespace cosserat_cable {

/// The quantities of which the channels are values or time derivatives: a position's component for
/// velocity and acceleration, the angle for its rate; in clamp a's frame where a channel says so.
class ChannelProbe {
 public:
  /// `sensors`: by channel, along which directions they show vectors.
  ChannelProbe(const std::vector<Channel>& channels, const std::vector<ChannelSensor>& sensors);

  void Sample(const Rig& rig, Eigen::Ref<Eigen::VectorXd> values);
  /// Of the channel: 0, 1 or 2, the derivative of the sampled quantity that it shows.
  static int DerivativeOrder(Quantity quantity);
  /// Whether the sampled quantity is an angle, known but for whole turns.
  static bool Winds(Quantity quantity) {
    return quantity == Quantity::kAngle || quantity == Quantity::kRate;
  }

 private:
  double Angle(const Rig& rig, double s);

  const std::vector<Channel>& channels_;
  std::vector<ChannelSensor> sensors_;
  std::vector<double> places_;           // arc lengths of all points that channels show [m]
  std::vector<std::size_t> place_of_;    // by channel that shows a point
  std::vector<Eigen::Vector3d> points_;  // scratch: where the places are [m]
  // Scratch: rotation about the tangent from clamp a to each node [rad].
  std::vector<double> twist_;
};

}  // namespace cosserat_cable
