// Dry friction between the parts of a section that is bent: a Prandtl-Ishlinskii model.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cosserat_cable/rod/section_law.h"

namespace cosserat_cable::rod {

/// Jenkins elements (a spring, and a slider in series) side by side in the two curvatures across
/// a3, each of an equal share of the stiffness. Slider i holds up to the spring's curvature e_i =
/// c_i; thresholds are spread evenly over c (1 - w) .. c (1 + w). Over a step the springs follow
/// the curvature, and what is beyond the threshold slips, in the direction of e (radial return):
///
///     e~ = e + (kappa - kappa_before),   e <- e~ min(1, c_i/|e~|),   M = sum_i k/n e_i
///
/// which is the gradient of sum_i k/n H_i(|e~|), H_i = x^2/2 below c_i and c_i x - c_i^2/2 above.
/// The step dissipates k/n c_i (|e~| - c_i) in each element that slips.
class BendingFriction : public SectionLaw {
 public:
  /// Sliders of a spread of thresholds: M is within 1e-3 of its largest value of what infinitely
  /// many would make.
  static constexpr int kSliders = 16;

  /// `stiffness` k while all stick [N m^2], `slip_curvature` c > 0 [1/m], `spread` w in [0, 1].
  BendingFriction(double stiffness, double slip_curvature, double spread);

  void ExchangeState(StateArchive* state) override { state->Exchange(&sprung_, &kappa_); }
  std::unique_ptr<SectionLaw> Clone() const override {
    return std::make_unique<BendingFriction>(*this);
  }
  void Reset(int elements) override;
  void Evaluate(int element, const ElementStrain& strain, double,
                SectionResponse* sum) const override;
  double Potential(int element, const ElementStrain& strain) const override;
  double Commit(int element, const ElementStrain& strain) override;
  void Rest(int element, const ElementStrain& strain) override;
  double Energy(int element, const ElementStrain& strain) const override;
  /// All stick: in a small vibration those that slip come to rest at their threshold.
  SectionMatrix SmallTangent(int element, const ElementStrain& strain) const override;

 private:
  using Sprung = Eigen::Vector2d;  // e [1/m]
  const Sprung* SprungOf(int element) const { return &sprung_[element * thresholds_.size()]; }

  double stiffness_, share_;            // all and one's [N m^2]
  std::vector<double> thresholds_;      // c_i [1/m]
  std::vector<Sprung> sprung_;          // by element and slider
  std::vector<Eigen::Vector2d> kappa_;  // of the last step, by element [1/m]
};

}  // namespace cosserat_cable::rod
