// `clamp_damping`: dashpots beside the springs of clamps that give way.
#include <algorithm>

#include "clamp_fields.h"
#include "cosserat_cable/causes/cause.h"

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

Cause ClampDampingCause() {
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "clamp_damping";
  law.shape = "clamps {a: {bending: ..., torsion: ...}, b: ...}";
  law.fields = ClampFields(NumberSpec::AtLeast(0, "N m s/rad"), "N m s/rad");
  law.check = Check;
  // Alone, it acts at a disc only.
  for (ExtensionField& field : law.fields)
    if (field.path == kDiscDashpot) field.neutral = 0.0;
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "viscous loss at a fixation";
  using Role = HypothesisNumber::Role;
  // At a disc; else a dashpot beside each spring of a clamp.
  cause.hypotheses = {{{{{"extensions.clamp_damping.b.torsion"}}}}};
  const auto beside = [](const std::string& path, Role role, double spring, NumberScale stiffness,
                         double loss, NumberScale dashpot) {
    return std::vector<HypothesisNumber>{
        {"extensions.clamp_compliance." + path, role, spring, stiffness},
        {"extensions.clamp_damping." + path, role, loss, dashpot}};
  };
  for (const std::string clamp : {"a.", "b."}) {
    cause.hypotheses.push_back(
        {{beside(clamp + "bending", Role::kInverse, 10, NumberScale::kClampBending, 3,
                 NumberScale::kClampDashpot),
          beside(clamp + "torsion", Role::kInverse, 10, NumberScale::kClampTorsion, 3,
                 NumberScale::kClampDashpot)}});
    for (const double loss : {0.02, 0.2, 1.0}) {
      Hypothesis found;
      for (const std::string axis : {"bending", "torsion"})
        found.components.push_back(beside(clamp + axis, Role::kFree, 1,
                                          NumberScale::kSimplerStiffness, loss,
                                          NumberScale::kSimplerDashpot));
      cause.from_simpler.push_back(found);
    }
  }
  cause.contains = {"clamp_compliance"};
  return cause;
}

}  // namespace cosserat_cable
