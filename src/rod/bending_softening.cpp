#include "cosserat_cable/rod/bending_softening.h"

#include <cmath>

namespace cosserat_cable::rod {

void BendingSoftening::Evaluate(int, const ElementStrain& strain, double,
                                SectionResponse* sum) const {
  const Eigen::Vector2d kappa = strain.kappa.head<2>();
  const double square = kappa.squaredNorm(), over = 1 / (square + c_squared_);
  const double secant = stiffness_ * square * over;
  sum->stress.segment<2>(3) += secant * kappa;
  const double slope = 2 * stiffness_ * c_squared_ * over * over;
  Eigen::Matrix2d tangent = kappa * kappa.transpose();
  tangent *= slope;  // not a factor of either side: it stays symmetric to the last bit
  tangent.diagonal().array() += secant;
  sum->tangent.block<2, 2>(3, 3) += tangent;
}

double BendingSoftening::Potential(int, const ElementStrain& strain) const {
  const double square = strain.kappa.head<2>().squaredNorm();
  return 0.5 * stiffness_ * (square - c_squared_ * std::log1p(square / c_squared_));
}

SectionMatrix BendingSoftening::SmallTangent(int element, const ElementStrain& strain) const {
  SectionResponse response;
  Evaluate(element, strain, 0, &response);
  return response.tangent;
}

}  // namespace cosserat_cable::rod
