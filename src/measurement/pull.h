// A force that pulls a point of a rod to a place: how an experiment holds its cable before it lets
// go.
#pragma once

#include "cosserat_cable/measurement/measurement_set.h"
#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable {

/// Moves the rod to the equilibrium in which the point `target.s` is at its position, held there by
/// whatever force that takes; from the present shape, in small moves. `gap`: what may be missing,
/// of the length.
/// @return whether it was found
bool PullTo(const PointAt& target, double gap, rod::Rod* rod);
/// As near as the solver gets.
inline constexpr double kThere = 1e-11;

/// The position [m] of the point at arc length `s`.
Eigen::Vector3d PointOn(const rod::Rod& rod, double s);

}  // namespace cosserat_cable
