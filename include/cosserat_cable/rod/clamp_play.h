// Play of a clamp in bending.
#pragma once

#include "cosserat_cable/rod/end_law.h"

namespace cosserat_cable::rod {

/// About the two axes across the clamp's a3 the section turns freely through `gap`, and against a
/// spring beyond, whatever the direction: M = stiffness f(|psi|) along psi with
///
///     f(x) = 0                             for               x <= gap - w/2
///            (x - gap + w/2)^2 / (2 w)     for gap - w/2 <   x <  gap + w/2
///            x - gap                       for gap + w/2 <=  x
///
/// The corner is rounded over w = kRounding gap, so that Newton's iteration sees a continuous
/// tangent. Without loss.
class ClampPlay final : public EndLaw {
 public:
  static constexpr double kRounding = 0.2;

  /// @pre both are positive: `gap` [rad], `stiffness` [N m/rad]
  ClampPlay(double gap, double stiffness) : gap_(gap), stiffness_(stiffness) {}

  std::unique_ptr<EndLaw> Clone() const override;
  Resistance Resist(const Eigen::Vector3d& psi, const Eigen::Vector3d& rate) const override;
  double Potential(const Eigen::Vector3d& psi) const override;
  double Commit(const Eigen::Vector3d&) override { return 0; }
  void Rest(const Eigen::Vector3d&) override {}
  double Energy(const Eigen::Vector3d& psi) const override { return Potential(psi); }

 private:
  double gap_, stiffness_;
};

}  // namespace cosserat_cable::rod
