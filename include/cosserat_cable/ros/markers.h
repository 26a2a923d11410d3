// A cable as rviz shows it: a tube coloured by curvature, its clamps, where it touches, its name.
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <vector>

#include "cosserat_cable/cable/cable_simulation.h"

namespace cosserat_cable {

struct MarkerStyle {
  int sides = 6;               ///< of the tube's cross-sections
  double turn = 0.25;          ///< at most, from one cross-section to the next [rad]
  double curvature_scale = 0;  ///< where the colours end [1/m]; 0: 1 / (5 diameters)
  double force_scale = 0.002;  ///< length of a contact force's arrow [m/N]
};

/// The markers of a cable's present state, in the axes of its reference link.
/// @param X_WR pose of the reference link in the world
visualization_msgs::MarkerArray MakeMarkers(const CableSimulation& cable, const Pose& X_WR,
                                            std::int64_t time, const MarkerStyle& style);

/// Takes a cable's markers out of the picture.
visualization_msgs::MarkerArray DeleteMarkers(const CableModel& model, std::int64_t time);

/// The colour at x in [0, 1]: the viridis map, perceptually even.
Eigen::Vector3d ViridisColor(double x);

/// The position at arc length s [m] of a cable's present state, in the world.
Eigen::Vector3d PositionAt(const CableSimulation& cable, double s);

}  // namespace cosserat_cable
