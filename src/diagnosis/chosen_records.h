// Which records of a large set are fitted: the others tell what is gained.
#pragma once

#include <vector>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// All experiments; of a set with so many unknown starts that candidates would take minutes each,
/// some of those, spread evenly over the set.
std::vector<int> ChosenRecords(const MeasurementSet& set);

/// The set with these experiments only.
MeasurementSet OfRecords(const MeasurementSet& set, const std::vector<int>& experiments);

}  // namespace cosserat_cable
