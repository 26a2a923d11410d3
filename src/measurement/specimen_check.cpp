#include "specimen_check.h"

namespace cosserat_cable {
namespace {

// Any damping will do to check the rest with.
void Know(DampingKey* damping) {
  if (damping->kind == DampingKey::Kind::kUnknown) *damping = {DampingKey::Kind::kNumber, 0};
}
void Know(CableKey<DampingKey>* key) {
  if (key->value) Know(&*key->value);
}
void Know(CableKey<std::array<DampingKey, 2>>* key) {
  if (!key->value) return;
  for (DampingKey& damping : *key->value) Know(&damping);
}

template <typename T>
void Refuse(const CableKey<T>& key, const std::string& why, Problems* problems) {
  if (key.given()) problems->Add(key.mark, "got this in a measurement set, which " + why);
}

}  // namespace

void CheckSpecimen(CableKeys keys, const SourceMark& cable, Problems* problems) {
  if (!keys.eta_GJ.given()) {
    problems->Add({cable.file, cable.line, cable.key + ".eta_GJ"},
                  "missing, expected a number >= 0 [N m^2 s], 'critical', or null where it is "
                  "unknown");
  }
  Know(&keys.eta_EI);
  Know(&keys.eta_GJ);
  Know(&keys.eta_EA);
  Know(&keys.eta_GA);
  CompleteCable(keys, cable, problems);
}

void RefuseVehicleKeys(const CableKeys& keys, Problems* problems) {
  Refuse(keys.avoid, "has no links", problems);
  Refuse(keys.contact, "has no bodies to touch", problems);
  Refuse(keys.apex_s, "has channels instead", problems);
}

}  // namespace cosserat_cable
