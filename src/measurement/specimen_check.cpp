#include "specimen_check.h"

#include <algorithm>
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

void CheckClampLaws(const CableKeys& keys, const std::vector<Experiment>& experiments,
                    Problems* problems) {
  if (!keys.extensions.value || experiments.empty()) return;
  const auto any = [&](EndCondition::Kind kind) {
    return std::any_of(experiments.begin(), experiments.end(),
                       [&](const Experiment& e) { return e.b.kind == kind; });
  };
  if (any(EndCondition::Kind::kClamp)) return;
  for (const ExtensionKey& key : *keys.extensions.value) {
    const std::string& name = key.extension.name;
    if (name != "clamp_friction" && name != "clamp_play") continue;
    const auto& marks = key.marks.front();
    for (const std::string group : {"b.", "b_torsion."}) {
      const auto first = marks.lower_bound(group);
      if (first == marks.end() || first->first.rfind(group, 0) != 0) continue;
      if (group == "b_torsion." && any(EndCondition::Kind::kDisc)) continue;
      problems->Add(first->second,
                    "got " + name +
                        " of clamp b, which no experiment has: end b is free or carries a disc; "
                        "expected none, or an experiment with a clamp at b");
    }
  }
}

void RefuseVehicleKeys(const CableKeys& keys, Problems* problems) {
  Refuse(keys.avoid, "has no links", problems);
  Refuse(keys.use_visual, "has no links", problems);
  Refuse(keys.contact, "has no bodies to touch", problems);
  Refuse(keys.apex_s, "has channels instead", problems);
}

}  // namespace cosserat_cable
