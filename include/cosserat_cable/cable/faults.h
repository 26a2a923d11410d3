// What a record, or the rig that it was taken on, does otherwise than its measurement set says.
//
// Each number has a neutral value, at which the fault is not there: zero, or one of a factor, or
// infinity of a frequency beyond which something gives way. A cable file has no faults.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// Of the record's time: t_record = (1 + scale) t_motion + delay.
struct ClockFault {
  double scale = 0;
  double delay = 0;  ///< [s]
  SourceMark mark;
};

/// Of a group of channels: measured = low_pass(R(tilt) scale true), about the world's origin, or
/// clamp a's of channels in its frame.
struct SensorFault {
  std::vector<std::string> channels;  ///< columns; none: all channels
  double scale = 1;
  Eigen::Vector3d tilt = Eigen::Vector3d::Zero();  ///< rotation vector [rad]
  double low_pass = 0;                             ///< time constant of the first order [s]
  SourceMark mark;
  std::map<std::string, SourceMark> marks;  ///< of the keys that a file gives
  std::vector<SourceMark> channel_marks;    ///< as many as channels, where a file gives them
};

/// How a clamp moves otherwise than its motion file or fixed pose says, whatever the cable does.
struct ClampMotionFault {
  double amplitude = 1;  ///< factor on the motion about its mean
  double phase = 0;      ///< advance at the motion's dominant frequency [rad], a shift in time
  /// A bracket between what was measured and the clamp: natural frequency [Hz], damping ratio.
  double bracket_frequency = std::numeric_limits<double>::infinity();
  double bracket_damping = 0.05;
  Eigen::Vector3d tilt = Eigen::Vector3d::Zero();  ///< rotation vector in the clamp's frame [rad]
  SourceMark mark;
  std::map<std::string, SourceMark> marks;  ///< of the keys that a file gives

  bool has_bracket() const { return bracket_frequency < std::numeric_limits<double>::infinity(); }
};

struct Faults {
  std::optional<ClockFault> clock;
  std::vector<SensorFault> sensor;
  std::optional<ClampMotionFault> a, b;  ///< base_motion
};

}  // namespace cosserat_cable
