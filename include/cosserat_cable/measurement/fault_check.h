// Which faults an experiment can have.
#pragma once

#include <string>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Whether the fault of this path ("faults.clock.scale") can show in the experiment: a clock where
/// something moves, a tilt where a channel has an axis, another motion of a clamp where there is
/// one that moves.
bool CanHaveFault(const std::string& path, const Experiment& experiment);

}  // namespace cosserat_cable
