// The smooth motion between two known ones.
#pragma once

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/math/quintic.h"

namespace cosserat_cable {

/// The motion that has `left` at time 0 and `right` at time `h` > 0 [s]: quintic in position, and
/// in the logarithm of the rotation from `left`'s.
class MotionPiece {
 public:
  MotionPiece(const Motion& left, const Motion& right, double h);

  /// At `time` in [0, h] [s].
  Motion At(double time) const;

 private:
  Eigen::Quaterniond q_left_;
  Quintic position_, phi_;
};

/// MotionPiece(left, right, h).At(time), for a single time.
Motion MotionBetween(const Motion& left, const Motion& right, double h, double time);

}  // namespace cosserat_cable
