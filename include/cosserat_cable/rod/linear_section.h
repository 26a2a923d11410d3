// A section whose components are coupled: a constant stiffness matrix beside the diagonal one.
#pragma once

#include "cosserat_cable/rod/section_law.h"

namespace cosserat_cable::rod {

/// stress = stiffness strain. The matrix is symmetric and need not be positive; with the section's
/// own stiffnesses on its diagonal it is.
class LinearSection : public SectionLaw {
 public:
  explicit LinearSection(const SectionMatrix& stiffness)
      : stiffness_(stiffness), answers_to_gamma_(!stiffness.topRows<3>().isZero(0)) {}

  std::unique_ptr<SectionLaw> Clone() const override {
    return std::make_unique<LinearSection>(*this);
  }
  bool answers_to_gamma() const override { return answers_to_gamma_; }
  void Reset(int) override {}
  void Evaluate(int, const ElementStrain& strain, double, SectionResponse* sum) const override;
  double Potential(int, const ElementStrain& strain) const override;
  double Commit(int, const ElementStrain&) override { return 0; }
  void Rest(int, const ElementStrain&) override {}
  double Energy(int element, const ElementStrain& strain) const override {
    return Potential(element, strain);
  }
  SectionMatrix SmallTangent(int, const ElementStrain&) const override { return stiffness_; }

 private:
  SectionMatrix stiffness_;
  bool answers_to_gamma_;
};

}  // namespace cosserat_cable::rod
