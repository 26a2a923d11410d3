// `maxwell`: relaxation, by springs in series with dashpots beside the Kelvin-Voigt element.
#include "cable_key_specs.h"
#include "cosserat_cable/rod/maxwell.h"
#include "extension_law.h"

namespace cosserat_cable {
namespace {

NumberSpec RelaxationTimeSpec() {
  return NumberSpec::Above(0, "s").AtMost(1e6).Hint("is it in ms?");
}

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  for (const auto& branch : extension.parts) {
    rod::SectionValue stiffness;
    stiffness.F.z() = branch.at("EA");
    stiffness.M = {branch.at("EI1"), branch.at("EI2"), branch.at("GJ")};
    rod->branches.push_back(std::make_shared<rod::MaxwellBranch>(stiffness, branch.at("tau")));
  }
}

}  // namespace

ExtensionLaw MaxwellExtension() {
  using Need = ExtensionField::Need;
  ExtensionLaw law;
  law.name = "maxwell";
  law.shape = "a branch {tau: ..., EI: ...}";
  law.list = true;
  law.fields = {{"tau", "s", RelaxationTimeSpec()},
                {"EI", "N m^2", BranchBendingStiffnessSpec(), Need::kAny, 0.0, true, 0.0},
                {"GJ", "N m^2", BranchBendingStiffnessSpec(), Need::kAny, 0.0, false, 0.0},
                {"EA", "N", BranchAxialStiffnessSpec(), Need::kAny, 0.0, false, 0.0}};
  law.enter = Enter;
  return law;
}

}  // namespace cosserat_cable
