// `clamp_compliance`: clamps that give way elastically in rotation.
#include "clamp_fields.h"
#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  ForEachClampAxis(extension, rod, [](rod::EndModel* end, int axis, double stiffness) {
    end->rotation[axis] = false;
    end->stiffness[axis] += stiffness;
  });
}

}  // namespace

Cause ClampComplianceCause() {
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "clamp_compliance";
  law.shape = "clamps {a: {bending: ..., torsion: ...}, b: ...}";
  law.fields = ClampFields(NumberSpec::Above(0, "N m/rad").AtMost(1e9), "N m/rad");
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "a clamp that gives way elastically";
  using Role = HypothesisNumber::Role;
  const auto gives = [](const std::string& path, NumberScale scale) {
    return std::vector<HypothesisNumber>{
        {"extensions.clamp_compliance." + path, Role::kInverse, 10, scale}};
  };
  const auto bending = [&](const std::string& clamp) {
    return gives(clamp + ".bending", NumberScale::kClampBending);
  };
  const auto torsion = [&](const std::string& clamp) {
    return gives(clamp + ".torsion", NumberScale::kClampTorsion);
  };
  cause.hypotheses = {{{bending("a"), torsion("a")}},
                      {{bending("b"), torsion("b")}},
                      {{bending("a"), bending("b")}}};
  return cause;
}

}  // namespace cosserat_cable
