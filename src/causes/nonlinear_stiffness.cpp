// `nonlinear_stiffness`: a bending stiffness that changes with the curvature.
#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/rod/bending_softening.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  const auto& numbers = extension.parts.front();
  if (numbers.at("change") == 0) return;
  const double EI = 0.5 * (rod->section.C_M.x() + rod->section.C_M.y());
  rod->laws.push_back(
      std::make_shared<rod::BendingSoftening>(EI, numbers.at("change"), numbers.at("curvature")));
}

}  // namespace

Cause NonlinearStiffnessCause() {
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "nonlinear_stiffness";
  law.shape = "a change {change: ..., curvature: ...}";
  // Where it softens by more, the moment falls with the curvature (bending_softening.h).
  law.fields = {{"change", "", NumberSpec::Above(-0.85, "").AtMost(100)},
                {"curvature", "1/m", NumberSpec::Above(0, "1/m").AtMost(1e4)}};
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "a bending stiffness that changes with curvature";
  using Role = HypothesisNumber::Role;
  for (const double curvature : {0.2, 0.6, 2.0})
    cause.hypotheses.push_back({{{{"extensions.nonlinear_stiffness.change"},
                                  {"extensions.nonlinear_stiffness.curvature", Role::kFree,
                                   curvature, NumberScale::kCurvature}}}});
  return cause;
}

}  // namespace cosserat_cable
