// `clamp_play`: clamps in which the cable's end is loose in bending.
#include "cosserat_cable/rod/clamp_play.h"
#include "extension_clamps.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  ForEachClamp(extension, rod, [](rod::EndModel* end, const ClampNumbers& of) {
    if (of("gap") == 0) return;
    for (const int axis : {0, 1}) end->rotation[axis] = false;
    end->laws.push_back(std::make_shared<rod::ClampPlay>(of("gap"), of("stiffness")));
  });
}

}  // namespace

ExtensionLaw ClampPlayExtension() {
  using Need = ExtensionField::Need;
  ExtensionLaw law;
  law.name = "clamp_play";
  law.shape = "clamps {a: {gap: ..., stiffness: ...}, b: ...}";
  for (const std::string clamp : {"a.", "b."}) {
    law.fields.push_back({clamp + "gap", "rad",
                          NumberSpec::AtLeast(0, "rad").AtMost(1.5).Hint("is it in degrees?"),
                          Need::kInGroup});
    law.fields.push_back({clamp + "stiffness", "N m/rad",
                          NumberSpec::Above(0, "N m/rad").AtMost(1e9), Need::kInGroup});
  }
  law.enter = Enter;
  return law;
}

}  // namespace cosserat_cable
