// `rest_curvature`: a cable that is bent or twisted while nothing acts on it.
#include "extension_law.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  const auto& numbers = extension.parts.front();
  rod->section.kappa0 += Eigen::Vector3d(numbers.at("k1"), numbers.at("k2"), numbers.at("twist"));
}

}  // namespace

ExtensionLaw RestCurvatureExtension() {
  using Need = ExtensionField::Need;
  ExtensionLaw law;
  law.name = "rest_curvature";
  law.shape = "a curvature {k1: ..., k2: ..., twist: ...}";
  const NumberSpec curvature = NumberSpec::AtLeast(-1e3, "1/m").AtMost(1e3);
  const NumberSpec twist = NumberSpec::AtLeast(-1e3, "rad/m").AtMost(1e3);
  law.fields = {{"k1", "1/m", curvature, Need::kAny, 0.0},
                {"k2", "1/m", curvature, Need::kAny, 0.0},
                {"twist", "rad/m", twist, Need::kAny, 0.0}};
  law.enter = Enter;
  return law;
}

}  // namespace cosserat_cable
