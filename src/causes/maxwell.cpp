// `maxwell`: relaxation, by springs in series with dashpots beside the Kelvin-Voigt element.
#include "cosserat_cable/rod/maxwell.h"

#include "cosserat_cable/cable/cable_key_specs.h"
#include "cosserat_cable/causes/cause.h"

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

Cause MaxwellCause() {
  using Need = ExtensionField::Need;
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "maxwell";
  law.shape = "a branch {tau: ..., EI: ...}";
  law.list = true;
  law.fields = {{"tau", "s", RelaxationTimeSpec()},
                {"EI", "N m^2", BranchBendingStiffnessSpec(), Need::kAny, 0.0, true, 0.0},
                {"GJ", "N m^2", BranchBendingStiffnessSpec(), Need::kAny, 0.0, false, 0.0},
                {"EA", "N", BranchAxialStiffnessSpec(), Need::kAny, 0.0, false, 0.0}};
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "relaxation of the material (Maxwell branch)";
  using Role = HypothesisNumber::Role;
  // One branch, in bending and in torsion as far as the records show them.
  for (const double tau : {0.01, 0.05, 0.2, 1.0, 5.0}) {
    const HypothesisNumber time = {"extensions.maxwell[0].tau", Role::kFree, tau,
                                   NumberScale::kPeriod};
    cause.hypotheses.push_back({{{{"extensions.maxwell[0].EI", Role::kSize, 0.1}, time},
                                 {{"extensions.maxwell[0].GJ", Role::kSize, 0.1}, time}}});
  }
  return cause;
}

}  // namespace cosserat_cable
