// What a model does in an experiment beside what its channels show.
#pragma once

#include <vector>

#include "cosserat_cable/measurement/experiment_simulation.h"

namespace cosserat_cable {

/// The experiment simulated with other channels at its record's times, coarsely: how large a motion
/// is and where it goes, not how it is measured. Not ok where it cannot be simulated, or has no
/// samples.
SimulatedRecord Probe(const Experiment& experiment, const Specimen& specimen,
                      const std::vector<Channel>& channels);

}  // namespace cosserat_cable
