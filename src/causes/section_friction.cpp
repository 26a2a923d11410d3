// `section_friction`: strands or layers that rub on each other where the cable bends.
#include "cosserat_cable/cable/cable_key_specs.h"
#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/rod/bending_friction.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  const auto& numbers = extension.parts.front();
  if (numbers.at("EI") == 0) return;
  rod->laws.push_back(std::make_shared<rod::BendingFriction>(
      numbers.at("EI"), numbers.at("slip_curvature"), numbers.at("spread")));
}

}  // namespace

Cause SectionFrictionCause() {
  using Need = ExtensionField::Need;
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "section_friction";
  law.shape = "friction {EI: ..., slip_curvature: ...}";
  law.fields = {{"EI", "N m^2", BranchBendingStiffnessSpec()},
                {"slip_curvature", "1/m", NumberSpec::Above(0, "1/m").AtMost(1e4)},
                {"spread", "", NumberSpec::AtLeast(0, "").AtMost(1), Need::kOptional, 0.5}};
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "friction between strands: hysteresis of moment over curvature";
  cause.form = 0.07;  // four thresholds in place of an even spread of them: docs/causes.md
  using Role = HypothesisNumber::Role;
  for (const double slip : {0.02, 0.08, 0.3, 1.0})
    cause.hypotheses.push_back(
        {{{{"extensions.section_friction.EI", Role::kSize, 0.1},
           {"extensions.section_friction.slip_curvature", Role::kFree, slip,
            NumberScale::kCurvature},
           {"extensions.section_friction.spread", Role::kHeld, 0.5, NumberScale::kOne}}}});
  return cause;
}

}  // namespace cosserat_cable
