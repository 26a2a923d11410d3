// Whether the clamps point where the record shows the cable.
#pragma once

#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Names quaternions that look as if they were written w first: the cable at rest is far from what
/// the record shows, and near it with w first. Neither their length nor the turns between them
/// tell: an exchange of components changes none.
void CheckAttitudes(const MeasurementSet& set, Problems* problems, Problems* warnings);

}  // namespace cosserat_cable
