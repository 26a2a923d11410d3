#pragma once

#include <functional>
#include <string>
#include <vector>

#include "../effects/kinds.h"
#include "../noise.h"

namespace cosserat_cable::generator {

/// An effect in one of its many forms, by its size alone.
struct Variation {
  const EffectKind* kind = nullptr;
  std::function<EffectValues(double size)> values;
  double first = 0.3;    ///< a size to start from
  double largest = 6.0;  ///< beyond it nothing is possible or sensible
  /// Whether it shows in torsion only.
  bool torsional = false;
};

/// The cause with everything but its size at random: which of its components are at work, where,
/// in which direction, at which threshold.
/// @param form of what may be several things: `torsion`, `delay`, `scale`, `tilt`, `low_pass`,
/// `amplitude`; empty: at random.
Variation varied(const EffectKind& kind, const EffectScale& scale, const std::string& form,
                 Random* random);

/// The effects of these variations at these sizes; clamp_damping beside a spring brings that too.
std::vector<EffectChoice> choicesOf(const std::vector<Variation>& variations,
                                    const std::vector<double>& sizes, const EffectScale& scale);

}  // namespace cosserat_cable::generator
