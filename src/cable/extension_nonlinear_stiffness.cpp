// `nonlinear_stiffness`: a bending stiffness that changes with the curvature.
#include "cosserat_cable/rod/bending_softening.h"
#include "extension_law.h"

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

ExtensionLaw NonlinearStiffnessExtension() {
  ExtensionLaw law;
  law.name = "nonlinear_stiffness";
  law.shape = "a change {change: ..., curvature: ...}";
  // Where it softens by more, the moment falls with the curvature (bending_softening.h).
  law.fields = {{"change", "", NumberSpec::Above(-0.85, "").AtMost(100)},
                {"curvature", "1/m", NumberSpec::Above(0, "1/m").AtMost(1e4)}};
  law.enter = Enter;
  return law;
}

}  // namespace cosserat_cable
