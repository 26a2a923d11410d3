// `anisotropy`: a bending stiffness that is not the same in all directions.
#include <cmath>

#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/rod/linear_section.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  const double difference = extension.parts.front().at("difference");
  const double roll = extension.parts.front().at("roll");
  if (difference == 0) return;
  Eigen::Vector3d& C_M = rod->section.C_M;
  const double EI = 0.5 * (C_M.x() + C_M.y());
  C_M.x() = EI * (1 + difference * std::cos(2 * roll));
  C_M.y() = EI * (1 - difference * std::cos(2 * roll));
  // What couples the two is a law of its own; along the principal axes there is none.
  if (roll == 0) return;
  rod::SectionMatrix stiffness = rod::SectionMatrix::Zero();
  stiffness(3, 4) = stiffness(4, 3) = EI * difference * std::sin(2 * roll);
  rod->laws.push_back(std::make_shared<rod::LinearSection>(stiffness));
}

void Check(const ExtensionKey& key, const CableKeys& cable, Problems* problems) {
  if (!cable.EI.value || (*cable.EI.value)[0] == (*cable.EI.value)[1]) return;
  problems->Add(key.mark,
                "got a difference beside an EI1 and an EI2 that differ already, expected EI alone");
}

}  // namespace

Cause AnisotropyCause() {
  using Need = ExtensionField::Need;
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "anisotropy";
  law.shape = "a difference {difference: ..., roll: ...}";
  law.fields = {{"difference", "", NumberSpec::Above(-1, "").Below(1)},
                {"roll", "rad", NumberSpec::AtLeast(-7, "rad").AtMost(7).Hint("is it in degrees?"),
                 Need::kOptional, 0.0}};
  law.check = Check;
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "a bending stiffness that depends on direction";
  using Role = HypothesisNumber::Role;
  constexpr double kDiagonal = 0.785398;  // between the section's axes
  for (const double roll : {0.0, kDiagonal})
    cause.hypotheses.push_back(
        {{{{"extensions.anisotropy.difference"},
           {"extensions.anisotropy.roll", Role::kFree, roll, NumberScale::kOne}}}});
  return cause;
}

}  // namespace cosserat_cable
