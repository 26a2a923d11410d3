// `section_friction`: strands or layers that rub on each other where the cable bends.
#include "cable_key_specs.h"
#include "cosserat_cable/rod/bending_friction.h"
#include "extension_law.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  const auto& numbers = extension.parts.front();
  if (numbers.at("EI") == 0) return;
  rod->laws.push_back(std::make_shared<rod::BendingFriction>(
      numbers.at("EI"), numbers.at("slip_curvature"), numbers.at("spread")));
}

}  // namespace

ExtensionLaw SectionFrictionExtension() {
  using Need = ExtensionField::Need;
  ExtensionLaw law;
  law.name = "section_friction";
  law.shape = "friction {EI: ..., slip_curvature: ...}";
  law.fields = {{"EI", "N m^2", BranchBendingStiffnessSpec()},
                {"slip_curvature", "1/m", NumberSpec::Above(0, "1/m").AtMost(1e4)},
                {"spread", "", NumberSpec::AtLeast(0, "").AtMost(1), Need::kOptional, 0.5}};
  law.enter = Enter;
  return law;
}

}  // namespace cosserat_cable
