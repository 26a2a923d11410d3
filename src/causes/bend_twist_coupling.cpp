// `bend_twist_coupling`: a section that twists where it is bent, as helical strands make it.
#include <cmath>

#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/rod/linear_section.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  const double c1 = extension.parts.front().at("c1"), c2 = extension.parts.front().at("c2");
  if (c1 == 0 && c2 == 0) return;
  const Eigen::Vector3d& C_M = rod->section.C_M;
  rod::SectionMatrix stiffness = rod::SectionMatrix::Zero();
  stiffness(3, 5) = stiffness(5, 3) = c1 * std::sqrt(C_M.x() * C_M.z());
  stiffness(4, 5) = stiffness(5, 4) = c2 * std::sqrt(C_M.y() * C_M.z());
  rod->laws.push_back(std::make_shared<rod::LinearSection>(stiffness));
}

// Beyond, a moment would bend the section against its own sense.
void Check(const ExtensionKey& key, const CableKeys&, Problems* problems) {
  const auto& numbers = key.extension.parts.front();
  const auto c1 = numbers.find("c1"), c2 = numbers.find("c2");
  if (c1 == numbers.end() || c2 == numbers.end()) return;
  const double square = c1->second * c1->second + c2->second * c2->second;
  if (square < 1) return;
  problems->Add(key.mark, "got c1^2 + c2^2 = " + FormatNumber(square) + ", expected less than 1");
}

}  // namespace

Cause BendTwistCouplingCause() {
  using Need = ExtensionField::Need;
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "bend_twist_coupling";
  law.shape = "a coupling {c1: ..., c2: ...}";
  const NumberSpec coupling = NumberSpec::Above(-1, "").Below(1);
  law.fields = {{"c1", "", coupling, Need::kAny, 0.0}, {"c2", "", coupling, Need::kAny, 0.0}};
  law.check = Check;
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "a coupling between bending and torsion";
  // Where the twist is neither held nor seen, all that is left of it is EI (1 - c^2).
  cause.acts_by_square = true;
  cause.hypotheses = {
      {{{{"extensions.bend_twist_coupling.c1"}}, {{"extensions.bend_twist_coupling.c2"}}}}};
  return cause;
}

}  // namespace cosserat_cable
