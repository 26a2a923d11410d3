#include "cosserat_cable/rod/bending_friction.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable::rod {

BendingFriction::BendingFriction(double stiffness, double slip_curvature, double spread)
    : stiffness_(stiffness) {
  const int count = spread > 0 ? kSliders : 1;
  share_ = stiffness / count;
  for (int i = 0; i < count; ++i)
    thresholds_.push_back(slip_curvature * (1 + spread * ((2 * i + 1.0) / count - 1)));
}

void BendingFriction::Reset(int elements) {
  sprung_.assign(elements * thresholds_.size(), Sprung::Zero());
  kappa_.assign(elements, Eigen::Vector2d::Zero());
}

void BendingFriction::Evaluate(int element, const ElementStrain& strain, double,
                               SectionResponse* sum) const {
  const Eigen::Vector2d change = strain.kappa.head<2>() - kappa_[element];
  const Sprung* before = SprungOf(element);
  double m1 = 0, m2 = 0, k11 = 0, k12 = 0, k22 = 0;
  for (std::size_t i = 0; i < thresholds_.size(); ++i) {
    const double x = before[i].x() + change.x(), y = before[i].y() + change.y();
    const double c = thresholds_[i], square = x * x + y * y;
    if (square <= c * c) {
      m1 += x;
      m2 += y;
      k11 += 1;
      k22 += 1;
      continue;
    }
    const double over = 1 / square, held = c * std::sqrt(over), beside = held * over;
    m1 += held * x;
    m2 += held * y;
    k11 += beside * y * y;
    k12 -= beside * x * y;
    k22 += beside * x * x;
  }
  sum->stress[3] += share_ * m1;
  sum->stress[4] += share_ * m2;
  sum->tangent(3, 3) += share_ * k11;
  sum->tangent(3, 4) += share_ * k12;
  sum->tangent(4, 3) += share_ * k12;
  sum->tangent(4, 4) += share_ * k22;
}

double BendingFriction::Potential(int element, const ElementStrain& strain) const {
  const Eigen::Vector2d change = strain.kappa.head<2>() - kappa_[element];
  const Sprung* before = SprungOf(element);
  double sum = 0;
  for (std::size_t i = 0; i < thresholds_.size(); ++i) {
    const double reach = (before[i] + change).norm(), c = thresholds_[i];
    sum += reach <= c ? 0.5 * reach * reach : c * (reach - 0.5 * c);
  }
  return share_ * sum;
}

double BendingFriction::Commit(int element, const ElementStrain& strain) {
  const Eigen::Vector2d change = strain.kappa.head<2>() - kappa_[element];
  Sprung* sprung = &sprung_[element * thresholds_.size()];
  double slipped = 0;
  for (std::size_t i = 0; i < thresholds_.size(); ++i) {
    sprung[i] += change;
    const double reach = sprung[i].norm(), c = thresholds_[i];
    if (reach <= c) continue;
    slipped += c * (reach - c);
    sprung[i] *= c / reach;
  }
  kappa_[element] = strain.kappa.head<2>();
  return share_ * slipped;
}

void BendingFriction::Rest(int element, const ElementStrain& strain) {
  std::fill_n(sprung_.begin() + element * thresholds_.size(), thresholds_.size(), Sprung::Zero());
  kappa_[element].setZero();
  Commit(element, strain);
}

double BendingFriction::Energy(int element, const ElementStrain&) const {
  const Sprung* sprung = SprungOf(element);
  double sum = 0;
  for (std::size_t i = 0; i < thresholds_.size(); ++i) sum += sprung[i].squaredNorm();
  return 0.5 * share_ * sum;
}

SectionMatrix BendingFriction::SmallTangent(int, const ElementStrain&) const {
  SectionMatrix stick = SectionMatrix::Zero();
  stick(3, 3) = stick(4, 4) = stiffness_;
  return stick;
}

}  // namespace cosserat_cable::rod
