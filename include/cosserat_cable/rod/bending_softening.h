// Bending stiffness that changes with the curvature, elastic.
#pragma once

#include "cosserat_cable/rod/section_law.h"

namespace cosserat_cable::rod {

/// Beside EI, isotropic in the curvature kappa across a3 (its unstressed part left out):
///
///     M = EI x kappa |kappa|^2/(|kappa|^2 + c^2)
///     energy = EI x/2 (|kappa|^2 - c^2 ln(1 + |kappa|^2/c^2))
///
/// so that the secant stiffness goes from EI where the section is straight to EI (1 + x) where it
/// is bent by much more than c. The whole tangent is positive for x > -8/9.
class BendingSoftening : public SectionLaw {
 public:
  /// `EI` [N m^2], `change` x, `curvature` c > 0 [1/m].
  BendingSoftening(double EI, double change, double curvature)
      : stiffness_(EI * change), c_squared_(curvature * curvature) {}

  std::unique_ptr<SectionLaw> Clone() const override {
    return std::make_unique<BendingSoftening>(*this);
  }
  void Reset(int) override {}
  void Evaluate(int, const ElementStrain& strain, double, SectionResponse* sum) const override;
  double Potential(int, const ElementStrain& strain) const override;
  double Commit(int, const ElementStrain&) override { return 0; }
  void Rest(int, const ElementStrain&) override {}
  double Energy(int element, const ElementStrain& strain) const override {
    return Potential(element, strain);
  }
  SectionMatrix SmallTangent(int element, const ElementStrain& strain) const override;

 private:
  double stiffness_, c_squared_;
};

}  // namespace cosserat_cable::rod
