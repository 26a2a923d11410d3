// extensions.anisotropy: EI (1 + difference) about the axis at angle roll from a1 in the section's
// plane, EI (1 - difference) about the axis across it.

#include <cmath>

#include "kinds.h"
#include "linear_section.h"

namespace cosserat_cable::generator {
namespace {

EffectValues defaults(const EffectScale&, double size) {
  return {{"difference", 0.04 * size}, {"roll", 0.6}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  const double d = valueOf(values, "difference"), roll = valueOf(values, "roll");
  const Eigen::Vector3d stiff(std::cos(roll), std::sin(roll), 0.0);
  const Eigen::Vector3d soft(-std::sin(roll), std::cos(roll), 0.0);
  const Eigen::Matrix3d C =
      site.cable.EI * d * (stiff * stiff.transpose() - soft * soft.transpose());
  return std::make_unique<LinearSection>(C, Eigen::Vector3d::Zero());
}

}  // namespace

const EffectKind kAnisotropy = {"anisotropy", "extensions.anisotropy", defaults, make};

}  // namespace cosserat_cable::generator
