#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "recalibration.h"
#include "variation.h"

namespace cosserat_cable::generator {

/// The experiments with these effects: held where a force of the same direction brings the cable as
/// it is.
std::vector<Experiment> withEffects(std::vector<Experiment> experiments,
                                    const std::vector<EffectChoice>& choices);

/// A size, and the strength that it has.
struct Strength {
  double size = 0.0;
  Recalibration::Answer left;
};

/// The size at which what recalibration leaves of the effect is near `target` times the noise, or
/// as near as possible sizes get.
Strength sizeFor(const Variation& variation, double target, double snr,
                 const std::vector<Experiment>& experiments, const EffectScale& scale);

}  // namespace cosserat_cable::generator
