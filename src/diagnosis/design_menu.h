// Experiments that a laboratory could add to a set: variations of those that it has done.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/measurement/measurement_set.h"
#include "motion_scales.h"

namespace cosserat_cable {

struct Design {
  std::string text;  ///< what is to be done: "record X again with ..."
  int like = 0;      ///< of which experiment it is a variation
  Experiment experiment;
};

/// Other lengths, amplitudes, orientations and rolls, a known mass, a slow cycle, a chirp, a longer
/// record: as far as each makes sense of an experiment. Those whose start is unknown are left out.
std::vector<Design> DesignMenu(const MeasurementSet& set, const MotionScales& scales);

}  // namespace cosserat_cable
