// extensions.structural_damping: a loss factor that is constant over frequency, by 21 Maxwell
// branches, four a decade, with corners from 0.01 Hz to 1 kHz. EI and GJ stay the stiffness after
// the slowest branch (16 s) has relaxed: at f the stiffness is EI (f/0.01 Hz)^(2 loss/pi) or so,
// and a series that ends at a higher corner has another EI for the same motion.

#include <cmath>

#include "kinds.h"
#include "relaxation.h"

namespace cosserat_cable::generator {
namespace {

EffectValues defaults(const EffectScale&, double size) { return {{"loss_factor", 0.02 * size}}; }

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  constexpr int kBranches = 21;
  std::vector<double> tau;
  for (int i = 0; i < kBranches; ++i) {
    tau.push_back(1.0 / (2.0 * std::acos(-1.0) * std::pow(10.0, -2.0 + 0.25 * i)));
  }
  const std::vector<double> share = constantLossSeries(tau, valueOf(values, "loss_factor"));
  std::vector<RelaxingBranch> branches;
  for (int i = 0; i < kBranches; ++i) {
    branches.push_back(
        {tau[i], share[i] * Eigen::Vector3d(site.cable.EI, site.cable.EI, site.cable.GJ)});
  }
  return std::make_unique<Relaxation>(branches);
}

}  // namespace

const EffectKind kStructuralDamping = {"structural_damping", "extensions.structural_damping",
                                       defaults, make};

}  // namespace cosserat_cable::generator
