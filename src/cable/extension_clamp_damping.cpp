// `clamp_damping`: dashpots beside the springs of clamps that give way.
#include <algorithm>

#include "extension_clamps.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  ForEachClampAxis(extension, rod, [](rod::EndModel* end, int axis, double damping) {
    end->damping[axis] = damping;
  });
}

// Where a clamp does not turn, a dashpot would be without effect. End b of a specimen may have a
// disc instead of a clamp: only its measurement set knows, and CheckAgainstVehicle refuses it
// there.
void Check(const ExtensionKey& key, const CableKeys& cable, Problems* problems) {
  const std::vector<ExtensionKey>& all = *cable.extensions.value;
  const auto gives_way = [&](const std::string& path) {
    return std::any_of(all.begin(), all.end(), [&](const ExtensionKey& other) {
      const std::string& name = other.extension.name;
      const auto& marks = other.marks.front();
      if (name == "clamp_compliance") return marks.count(path) > 0;
      // These let the end turn in bending.
      if (name != "clamp_friction" && name != "clamp_play") return false;
      return path == "a.bending"
                 ? marks.count("a.stiffness") + marks.count("a.spring") > 0
                 : path == "b.bending" && marks.count("b.stiffness") + marks.count("b.spring") > 0;
    });
  };
  for (const auto& [path, mark] : key.marks.front()) {
    if (path == kDiscDashpot || gives_way(path)) continue;
    problems->Add(mark,
                  "got a loss where the clamp is rigid, expected the stiffness with which it gives "
                  "way in clamp_compliance: " +
                      path);
  }
}

}  // namespace

ExtensionLaw ClampDampingExtension() {
  ExtensionLaw law;
  law.name = "clamp_damping";
  law.shape = "clamps {a: {bending: ..., torsion: ...}, b: ...}";
  law.fields = ClampFields(NumberSpec::AtLeast(0, "N m s/rad"), "N m s/rad");
  law.check = Check;
  // Alone, it acts at a disc only.
  for (ExtensionField& field : law.fields)
    if (field.path == kDiscDashpot) field.neutral = 0.0;
  law.enter = Enter;
  return law;
}

}  // namespace cosserat_cable
