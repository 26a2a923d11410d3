#pragma once

#include <array>
#include <vector>

#include "effect.h"

namespace cosserat_cable::generator {

/// A Maxwell branch beside the section's Kelvin-Voigt element.
struct RelaxingBranch {
  double tau = 0.0;   ///< [s]
  Eigen::Vector3d C;  ///< stiffness against K1, K2, K3 [N m^2]
};

/// Branches of M = C (K - z), tau dz/dt = K - z. The strain within a step is the cubic through the
/// values and rates at both ends, for which the convolution with exp(-t/tau) is integrated exactly:
/// order four, and stable however long the step.
class Relaxation : public Effect {
 public:
  explicit Relaxation(std::vector<RelaxingBranch> branches) : branches_(std::move(branches)) {}
  bool bends() const override { return true; }
  void addMoments(const SectionState& at, Points* M) const override;
  void commit(const SectionState& at, const ClampTurn* turns) override;

 private:
  Points internal(const SectionState& at, size_t branch) const;

  std::vector<RelaxingBranch> branches_;
  double t_ = 0.0;         // of the last commit
  Points K_, Kd_;          // there
  std::vector<Points> z_;  // there, of each branch
};

/// Branches at these relaxation times, of stiffness in parts of the relaxed one, for a loss factor
/// E''/E' that is `loss` between 0.02 Hz and 500 Hz: least squares over the frequencies.
std::vector<double> constantLossSeries(const std::vector<double>& tau, double loss);

}  // namespace cosserat_cable::generator
