// What an unknown start is looked for in: the shapes of small swings that a record can show.
#pragma once

#include <vector>

#include "cosserat_cable/measurement/experiment_simulation.h"

namespace cosserat_cable {

struct StartShape {
  SwingShape shape;
  double size = 0;  ///< an amplitude that the record makes plausible, in units of the shape
};

/// The slowest shapes about the experiment's rest, those that its channels see: slower than half
/// the sampling rate, and not with nodes at all channels. The faster a shape, the smaller it is
/// taken to be.
std::vector<StartShape> StartShapes(const Experiment& experiment, const Specimen& specimen);

}  // namespace cosserat_cable
