// `clamp_friction`: clamps that turn in bending against a spring and a dry friction.
#include "cosserat_cable/rod/clamp_friction.h"

#include "clamp_fields.h"
#include "cosserat_cable/causes/cause.h"

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

Cause ClampFrictionCause() {
  using Need = ExtensionField::Need;
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
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
  cause.name = law.name;
  cause.words = "dry friction or partial slip at a clamp";
  using Role = HypothesisNumber::Role;
  // Thresholds in parts of the largest moment: from nearly all of the motion slipping to little.
  for (const std::string clamp : {"a.", "b."})
    for (const double moment : {0.03, 0.1, 0.3})
      cause.hypotheses.push_back({{{{"extensions.clamp_friction." + clamp + "stuck", Role::kInverse,
                                     20, NumberScale::kClampBending},
                                    {"extensions.clamp_friction." + clamp + "spring",
                                     Role::kInverse, 10, NumberScale::kClampBending},
                                    {"extensions.clamp_friction." + clamp + "slip_moment",
                                     Role::kFree, moment, NumberScale::kClampMoment}}}});
  for (const std::string clamp : {"a.", "b."})
    for (const double moment : {0.03, 0.1, 0.3, 0.8})
      for (const double spring : {0.4, 1.0})
        for (const double stuck : {1.0, 4.0})
          cause.from_simpler.push_back({{{{"extensions.clamp_friction." + clamp + "stuck",
                                           Role::kFree, stuck, NumberScale::kSimplerStiffness},
                                          {"extensions.clamp_friction." + clamp + "spring",
                                           Role::kFree, spring, NumberScale::kSimplerStiffness},
                                          {"extensions.clamp_friction." + clamp + "slip_moment",
                                           Role::kFree, moment, NumberScale::kClampMoment}}}});
  cause.contains = {"clamp_compliance"};
  return cause;
}

}  // namespace cosserat_cable
