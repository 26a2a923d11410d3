// Several rods stepped side by side in the lanes of the vector units: several times as fast as one
// by one.
#pragma once

#include <memory>
#include <vector>

#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable::rod {

/// Where one rod's clamps go in a step, and what acts on it.
struct RodDrive {
  const Pose* a = nullptr;
  const Pose* b = nullptr;
  const Load* load = nullptr;
};

/// Steps up to `kMaxRods` rods, up to four of them at the cost of four, with the same number of
/// elements and the same ends clamped. A rod's result does not depend, to the last bit, on which
/// others are stepped with it, unless some have ends that are held in part (EndModel) and it has
/// not: then by rounding, as it may differ from Rod::Step's.
class RodBatch {
 public:
  static constexpr int kMaxRods = 8;
  /// As many as this machine's vectors hold: more are stepped, but no faster.
  static int PreferredRods();

  /// @throws std::invalid_argument where the rods do not fit together, or one has joints
  explicit RodBatch(const std::vector<Rod*>& rods);
  ~RodBatch();
  RodBatch(RodBatch&&) noexcept;
  RodBatch& operator=(RodBatch&&) noexcept;

  /// As Rod::Step for each rod; those whose drive has no `a` are left alone, with a report that has
  /// not converged. Valid until the next step.
  const std::vector<SolveReport>& Step(double dt, const std::vector<RodDrive>& drives);

 private:
  struct Impl;
  template <class T>
  struct ImplInLanes;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosserat_cable::rod
