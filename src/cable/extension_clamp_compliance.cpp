// `clamp_compliance`: clamps that give way elastically in rotation.
#include "extension_clamps.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  ForEachClampAxis(extension, rod, [](rod::EndModel* end, int axis, double stiffness) {
    end->rotation[axis] = false;
    end->stiffness[axis] += stiffness;
  });
}

}  // namespace

ExtensionLaw ClampComplianceExtension() {
  ExtensionLaw law;
  law.name = "clamp_compliance";
  law.shape = "clamps {a: {bending: ..., torsion: ...}, b: ...}";
  law.fields = ClampFields(NumberSpec::Above(0, "N m/rad").AtMost(1e9), "N m/rad");
  law.enter = Enter;
  return law;
}

}  // namespace cosserat_cable
