// extensions.external_damping: -rhoA rate v per length, v the world velocity; masses do not count.

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class ExternalDamping : public Effect {
 public:
  explicit ExternalDamping(double factor) : factor_(factor) {}
  int stations() const override { return 24; }
  void addForces(const StationState& at, Points* force) const override {
    *force -= factor_ * at.velocity;
  }

 private:
  double factor_;  // [kg/(m s)]
};

EffectValues defaults(const EffectScale& scale, double size) {
  return {{"rate", 0.03 * size * scale.frequency}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  return std::make_unique<ExternalDamping>(site.cable.rhoA * valueOf(values, "rate"));
}

}  // namespace

const EffectKind kExternalDamping = {"external_damping", "extensions.external_damping", defaults,
                                     make};

}  // namespace cosserat_cable::generator
