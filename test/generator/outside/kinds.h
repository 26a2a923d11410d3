#pragma once

#include <vector>

#include "../effects/effect.h"

namespace cosserat_cable::generator {

// Laws that are none of the library's causes, one per file of this folder. Their values hold a
// `seed` where something about them is random.
extern const EffectKind kParametricTension, kCoupledStrand, kIntermittentSlip, kEddyDamping,
    kMovingSlug, kRandomTaps, kStribeckSupport, kMagnet;

/// All of them.
const std::vector<const EffectKind*>& outsideKinds();

}  // namespace cosserat_cable::generator
