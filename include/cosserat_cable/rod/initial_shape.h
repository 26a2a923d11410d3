// A first guess of a cable's shape between two clamps, for the search of its equilibrium.
#pragma once

#include <vector>

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable::rod {

/// Poses of `elements + 1` nodes at equal arc lengths on a smooth curve of the given length [m]
/// from `a` to `b` that leaves and arrives along their a3, bowed to where the clamps point, else to
/// where `down` points; frames transported without twist, the rest of the twist (below half a turn)
/// spread evenly. Where the clamps are farther apart than `length`, the curve is as short as it
/// gets.
std::vector<Pose> BowedShape(const Pose& a, const Pose& b, double length, int elements,
                             const Eigen::Vector3d& down);

/// The straight unstressed rod from `a` along its a3.
std::vector<Pose> StraightShape(const Pose& a, double length, int elements);

}  // namespace cosserat_cable::rod
