// The smooth motion between two known ones.
#pragma once

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

/// The motion at `time` in [0, h] [s] that has `left` at 0 and `right` at h: quintic in position,
/// and in the logarithm of the rotation from `left`'s.
Motion MotionBetween(const Motion& left, const Motion& right, double h, double time);

}  // namespace cosserat_cable
