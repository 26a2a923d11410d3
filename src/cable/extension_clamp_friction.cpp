// `clamp_friction`: clamps that turn in bending against a spring and a dry friction.
#include "cosserat_cable/rod/clamp_friction.h"
#include "extension_clamps.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  ForEachClamp(extension, rod, [](rod::EndModel* end, const ClampNumbers& of) {
    const double stuck = of("stuck"), slip_moment = of("slip_moment"), spring = of("spring");
    const bool rubs = stuck > 0 && slip_moment > 0;
    if (!rubs && spring == 0) return;
    for (const int axis : {0, 1}) {
      end->rotation[axis] = false;
      end->stiffness[axis] += spring;
    }
    if (rubs) end->laws.push_back(std::make_shared<rod::ClampFriction>(stuck, slip_moment));
  });
}

}  // namespace

ExtensionLaw ClampFrictionExtension() {
  using Need = ExtensionField::Need;
  ExtensionLaw law;
  law.name = "clamp_friction";
  law.shape = "clamps {a: {stuck: ..., slip_moment: ..., spring: ...}, b: ...}";
  const NumberSpec stiffness = NumberSpec::AtLeast(0, "N m/rad").AtMost(1e9);
  for (const std::string clamp : {"a.", "b."}) {
    law.fields.push_back({clamp + "stuck", "N m/rad", stiffness, Need::kInGroup});
    law.fields.push_back(
        {clamp + "slip_moment", "N m", NumberSpec::AtLeast(0, "N m").AtMost(1e6), Need::kInGroup});
    law.fields.push_back({clamp + "spring", "N m/rad", stiffness, Need::kInGroup});
  }
  law.enter = Enter;
  return law;
}

}  // namespace cosserat_cable
