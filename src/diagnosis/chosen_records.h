// Which records of a large set are fitted: the others tell what is gained.
#pragma once

#include <vector>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// All experiments; of a set whose candidates would take minutes each, the quasi-static ones and
/// some of the others, spread evenly over the set.
std::vector<int> ChosenRecords(const MeasurementSet& set);

/// The set with these experiments only.
MeasurementSet OfRecords(const MeasurementSet& set, const std::vector<int>& experiments);

}  // namespace cosserat_cable
