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

/// How far the data tell the cause from a rival: chi, the square root of what is left of the
/// cause's chi^2 when the plain rod's parameters and a few random forms of the rival, as far as
/// they are linear, are fitted beside each other.
double separation(const Variation& cause, double size, const EffectKind& rival,
                  const std::string& rival_form, double snr,
                  const std::vector<Experiment>& experiments, const EffectScale& scale,
                  Random* random);

}  // namespace cosserat_cable::generator
