// extensions.added_mass: a point mass on the axis; an element ends there. A specimen that ends
// before it does not have it.

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class AddedMass : public Effect {
 public:
  AddedMass(double s, double mass) : mass_{s, mass} {}
  void equip(CableData* cable) const override {
    if (mass_.s <= cable->length && mass_.mass > 0.0) cable->masses.push_back(mass_);
  }

 private:
  PointMass mass_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  return {{"s", 0.8 * scale.shortest},
          {"mass", 0.05 * size * scale.cable.rhoA * scale.cable.length}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite&) {
  return std::make_unique<AddedMass>(valueOf(values, "s"), valueOf(values, "mass"));
}

}  // namespace

const EffectKind kAddedMass = {"added_mass", "extensions.added_mass", defaults, make};

}  // namespace cosserat_cable::generator
