// What of a set may be another one beside its channels: signs and units of what acts on the cable,
// and how its clamps move.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Something of the set beside the channels that may be another one, for all of the record.
struct InputSlip {
  std::string kind;  ///< "load", "mass", "motion", "gravity", "start", "parameter"
  std::string text;
  double factor = 1;   ///< by which the set's value is multiplied
  std::string named;   ///< a parameter that is to be found with the others
  bool of_set = true;  ///< it holds for all of the set's records
  /// Of a factor that is to be found: its range, else 0. `text` goes after it.
  double least = 0, most = 0;
  std::function<void(double factor, MeasurementSet*)> change;

  bool free_factor() const { return most > 0; }
  /// The set with it mended.
  MeasurementSet Mended(const MeasurementSet& set, double by) const {
    MeasurementSet changed = set;
    change(by, &changed);
    return changed;
  }
};

/// Signs and units of what acts on the cable in an experiment, as people mistake them. Factors that
/// are to be found come last.
std::vector<InputSlip> InputSlips(const MeasurementSet& set, std::size_t experiment);

/// Of those, what may be wrong with how the clamps move: units, mirrored and exchanged axes,
/// rotations the other way, gains.
void AddMotionSlips(const MeasurementSet& set, std::size_t experiment,
                    std::vector<InputSlip>* slips);

}  // namespace cosserat_cable
