// Which long intervals between the samples of an edge are gaps.
#pragma once

#include <cmath>

#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

/// An interval of more than `max_gap` is a gap, unless nothing has moved across it and nothing was
/// to be expected: the edge has never moved so far, or was never sampled faster (a constant
/// transform that is sent once a second).
class GapRule {
 public:
  /// Whether the interval of `period` [s] between two samples that follow each other is a gap. To
  /// be asked of each.
  bool IsGap(double period, double max_gap, const Pose& before, const Pose& after) {
    // Rounding of a pose that does not move [m], [half radians].
    constexpr double kStill = 1e-6;
    const bool still = (after.p - before.p).squaredNorm() < kStill * kStill &&
                       1 - std::abs(after.q.dot(before.q)) < kStill * kStill;
    if (!still) moves_ = true;
    if (period <= max_gap) is_fast_ = true;
    return period > max_gap && !(still && !(moves_ && is_fast_));
  }
  /// Whether any two samples differed.
  bool moves() const { return moves_; }

 private:
  bool moves_ = false, is_fast_ = false;
};

}  // namespace cosserat_cable
