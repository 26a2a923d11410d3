// The rod that a cable's file describes.
#pragma once

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable {

/// Section, masses and extensions of the cable, both ends clamped as far as its extensions let
/// them. `gravity_W` [m/s^2].
rod::RodModel MakeRodModel(const CableModel& cable, const Eigen::Vector3d& gravity_W);

}  // namespace cosserat_cable
