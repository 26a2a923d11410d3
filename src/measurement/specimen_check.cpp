#include "specimen_check.h"

#include <utility>

#include "cosserat_cable/measurement/specimen.h"

namespace cosserat_cable {
namespace {

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
  // Any damping will do to check the rest with.
  CompleteCable(WithoutUnknownDamping(std::move(keys)), cable, problems);
}

void RefuseVehicleKeys(const CableKeys& keys, Problems* problems) {
  Refuse(keys.avoid, "has no links", problems);
  Refuse(keys.use_visual, "has no links", problems);
  Refuse(keys.contact, "has no bodies to touch", problems);
  Refuse(keys.apex_s, "has channels instead", problems);
}

}  // namespace cosserat_cable
