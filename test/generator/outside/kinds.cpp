#include "kinds.h"

namespace cosserat_cable::generator {

const std::vector<const EffectKind*>& outsideKinds() {
  static const std::vector<const EffectKind*> kinds = {
      &kParametricTension, &kCoupledStrand, &kIntermittentSlip, &kEddyDamping,
      &kMovingSlug,        &kRandomTaps,    &kStribeckSupport,  &kMagnet};
  return kinds;
}

}  // namespace cosserat_cable::generator
