#pragma once

#include <set>
#include <string>
#include <vector>

#include "../noise.h"
#include "../rigs.h"

namespace cosserat_cable::generator {

/// What can be measured of a cable. The lengths are in parts of the whole one.
enum class Rig {
  kSmall,         ///< a small ring-down of the whole length
  kLarge,         ///< a large one at 0.8 of it, rolled by 90 degrees
  kShort,         ///< a small one at 0.55 of it
  kSame,          ///< a small one of the whole length in the large one's plane
  kSmallAtLarge,  ///< a small one at 0.8 of the length in the large one's plane
  kSteep,         ///< a small one whose clamp is tilted far more than the others'
  kSweep,         ///< the clamp is swept across the first mode
  kWideSweep,     ///< the same up to the second mode
  kTone,          ///< the clamp moves as one sine
  kTorsion,       ///< a disc, with the positions of the end
  kTorsionShort,  ///< the same disc at half of that length
  kArch,          ///< both ends clamped, one of them swept
  kBend,          ///< equilibria under a force at the end
  kBendAcross,    ///< the same across that plane
};

/// A cable that is rigged up in some of these ways, all numbers random, and once more for a record
/// that is not shown.
struct RigMix {
  CableData cable;
  std::vector<Experiment> seen;
  Experiment unseen;
};

/// A cable of 0.15 to 1 m with damping ratios of 0.01 to 0.08.
CableData blindCable(Random* random);

/// @param torsion whether the record that is not shown is one of torsion; a driven one if not.
RigMix mixRigs(const std::set<Rig>& rigs, bool torsion, Random* random);

}  // namespace cosserat_cable::generator
