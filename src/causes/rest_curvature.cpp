// `rest_curvature`: a cable that is bent or twisted while nothing acts on it.
#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {
namespace {

void Enter(const CableExtension& extension, rod::RodModel* rod) {
  const auto& numbers = extension.parts.front();
  rod->section.kappa0 += Eigen::Vector3d(numbers.at("k1"), numbers.at("k2"), numbers.at("twist"));
}

}  // namespace

Cause RestCurvatureCause() {
  using Need = ExtensionField::Need;
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "rest_curvature";
  law.shape = "a curvature {k1: ..., k2: ..., twist: ...}";
  const NumberSpec curvature = NumberSpec::AtLeast(-1e3, "1/m").AtMost(1e3);
  const NumberSpec twist = NumberSpec::AtLeast(-1e3, "rad/m").AtMost(1e3);
  law.fields = {{"k1", "1/m", curvature, Need::kAny, 0.0},
                {"k2", "1/m", curvature, Need::kAny, 0.0},
                {"twist", "rad/m", twist, Need::kAny, 0.0}};
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "a curvature of the unstressed cable";
  cause.hypotheses = {{{{{"extensions.rest_curvature.k1"}},
                        {{"extensions.rest_curvature.k2"}},
                        {{"extensions.rest_curvature.twist"}}}}};
  return cause;
}

}  // namespace cosserat_cable
