// The start of an experiment that was already swinging, from the beginning of its record.
#pragma once

#include <string>

#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/measurement/measurement_set.h"
#include "cosserat_cable/measurement/specimen.h"

namespace cosserat_cable {

/// The specimen of these keys with the swing that explains the first tenth of the record, two
/// periods at least, best. What is wrong goes to `problems`.
Specimen EstimateStart(const Experiment& experiment, const CableKeys& keys, Problems* problems);

}  // namespace cosserat_cable
