// A Maxwell branch: a spring and a dashpot in series, beside the Kelvin-Voigt element. One makes
// the section a standard linear solid, several a generalised Maxwell solid.
#pragma once

#include <vector>

#include "cosserat_cable/rod/section_branch.h"

namespace cosserat_cable::rod {

/// d(sigma)/dt + sigma/tau = E d(strain)/dt, integrated exactly for a strain that is linear over
/// the step:  sigma_1 = exp(-x) sigma_0 + E (1 - exp(-x))/x (strain_1 - strain_0),  x = dt/tau. In
/// extension, bending and torsion; shear has none.
class MaxwellBranch : public SectionBranch {
 public:
  /// `stiffness`: E per component [N], [N m^2], not negative; `tau` > 0 [s].
  MaxwellBranch(const SectionValue& stiffness, double tau);

  std::unique_ptr<SectionBranch> Clone() const override;
  void ExchangeState(StateArchive* state) override;
  void SetElements(int elements) override;
  void BeginStep(double dt) override;
  SectionValue StepStiffness() const override;
  SectionValue Offset(int element) const override;
  void Commit(int element, const ElementStrain& strain) override;
  void Rest(int element, const ElementStrain& strain) override;
  SectionValue StaticStiffness() const override { return {}; }
  double Energy(int element) const override;
  double DissipationRate(int element) const override;
  std::vector<Relaxation> Relaxations() const override { return {{Spread(stiffness_), 1 / tau_}}; }

 private:
  // Extension, bending about a1 and a2, torsion.
  using Components = Eigen::Array4d;
  struct State {
    Components sigma = Components::Zero();   // [N], [N m]
    Components strain = Components::Zero();  // [1], [1/m]
  };
  static Components Pick(const ElementStrain& strain) {
    return {strain.gamma.z(), strain.kappa.x(), strain.kappa.y(), strain.kappa.z()};
  }
  static SectionValue Spread(const Components& c) { return {{0, 0, c[0]}, {c[1], c[2], c[3]}}; }

  Components stiffness_;
  double tau_;
  double decay_ = 1, mean_decay_ = 1;  // of the step begun
  std::vector<State> states_;          // by element
};

}  // namespace cosserat_cable::rod
