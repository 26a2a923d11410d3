#pragma once

#include <vector>

#include "frame_motion.h"

namespace cosserat_cable::generator {

/// A sine of the excitation; a sweep where the frequency ends elsewhere.
struct ExcitationLine {
  double amplitude = 0.0;       ///< [m]
  double frequency = 0.0;       ///< at time 0 [Hz]
  double last_frequency = 0.0;  ///< at the end [Hz]
  double phase = 0.0;           ///< [rad]
};

/// How a clamp is shaken: along a line and, in proportion, about an axis; it sets in smoothly.
struct Excitation {
  FrameMotion start;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< world, of length 1
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();       ///< world, of length 1
  double turn = 0.0;                                     ///< rotation over displacement [rad/m]
  std::vector<ExcitationLine> lines;
  double duration = 1.0;  ///< [s]
  double onset = 0.3;     ///< [s]
};

FrameCurve excite(const Excitation& excitation);

/// Sum of the lines' amplitudes [m].
double largestDisplacement(const Excitation& excitation);

}  // namespace cosserat_cable::generator
