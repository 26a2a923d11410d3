#include "cosserat_cable/rod/linear_section.h"

namespace cosserat_cable::rod {
namespace {

SectionVector InOne(const ElementStrain& strain) {
  SectionVector all;
  all << strain.gamma, strain.kappa;
  return all;
}

}  // namespace

void LinearSection::Evaluate(int, const ElementStrain& strain, double, SectionResponse* sum) const {
  if (answers_to_gamma_)
    sum->stress += stiffness_ * InOne(strain);
  else
    sum->stress.tail<3>() += stiffness_.bottomRightCorner<3, 3>() * strain.kappa;
  sum->tangent += stiffness_;
}

double LinearSection::Potential(int, const ElementStrain& strain) const {
  const SectionVector all = InOne(strain);
  return 0.5 * all.dot(stiffness_ * all);
}

}  // namespace cosserat_cable::rod
