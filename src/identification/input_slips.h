// What of a set may be another one beside its channels: signs and units of what acts on the cable.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Something of the set beside the channels that may be another one, for all of the record.
struct InputSlip {
  std::string kind;  ///< "load", "mass", "start", "parameter"
  std::string text;
  double factor = 1;   ///< by which the set's value is multiplied
  std::string named;   ///< a parameter that is to be found with the others
  bool of_set = true;  ///< it holds for all of the set's records
  MeasurementSet set;  ///< with it mended
};

/// Signs and units of what acts on the cable in an experiment, as people mistake them.
std::vector<InputSlip> InputSlips(const MeasurementSet& set, std::size_t experiment);

}  // namespace cosserat_cable
