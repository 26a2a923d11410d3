// The cables of a vehicle, stepped side by side.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "cosserat_cable/cable/cable_simulation.h"

namespace cosserat_cable {

/// How a cable is stepped that has no other of its kind beside it.
enum class LoneCable {
  kInLanes,  ///< as others are: it does not see, to the last bit, whether there are any
  kByItself  ///< by CableSimulation::Step: in half the time, but rounded otherwise
};

/// Takes the same steps as CableSimulation::Step, but for rounding, several cables at a time: those
/// with equal numbers of elements, and the same ends held rigidly, go in groups of up to four (up
/// to eight, where the machine's vectors are as wide) through the lanes of one kernel. What a cable
/// does does not depend, to the last bit, on how they are grouped, on what those in its group are
/// and do, nor, but for LoneCable::kByItself, on whether there are others at all.
class CableFleet {
 public:
  /// The simulations outlive this, and are stepped through it only. `threads`: for which there are
  /// to be groups, as long as these are worth a kernel.
  explicit CableFleet(const std::vector<CableSimulation*>& cables, int threads = 1,
                      LoneCable lone = LoneCable::kInLanes);
  ~CableFleet();
  CableFleet(CableFleet&&) noexcept;
  CableFleet& operator=(CableFleet&&) noexcept;

  /// Cables that go through one kernel together. Groups may be stepped in different threads.
  std::size_t group_count() const;
  /// Indices of a group's cables.
  const std::vector<std::size_t>& members(std::size_t group) const;

  /// Advances the k-th member of a group by `dt` [s] to `then[k]`; a null pointer leaves it where
  /// it is, and its outcome as it was.
  void StepGroup(std::size_t group, double dt, const std::vector<const Surroundings*>& then,
                 std::vector<StepOutcome>* outcomes);

  /// Advances cable i by `dt` [s] to `then[i]`; a null pointer leaves it where it is.
  /// @return an outcome for each cable, in their order
  std::vector<StepOutcome> Step(double dt, const std::vector<const Surroundings*>& then);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosserat_cable
