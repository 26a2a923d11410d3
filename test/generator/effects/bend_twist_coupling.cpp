// extensions.bend_twist_coupling: off-diagonal stiffness c1 sqrt(EI GJ) between K1 and K3, c2
// between K2 and K3.

#include <cmath>

#include "kinds.h"
#include "linear_section.h"

namespace cosserat_cable::generator {
namespace {

EffectValues defaults(const EffectScale&, double size) {
  return {{"c1", 0.2 * size}, {"c2", -0.12 * size}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  const double unit = std::sqrt(site.cable.EI * site.cable.GJ);
  Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
  C(0, 2) = C(2, 0) = unit * valueOf(values, "c1");
  C(1, 2) = C(2, 1) = unit * valueOf(values, "c2");
  return std::make_unique<LinearSection>(C, Eigen::Vector3d::Zero());
}

}  // namespace

const EffectKind kBendTwistCoupling = {"bend_twist_coupling", "extensions.bend_twist_coupling",
                                       defaults, make};

}  // namespace cosserat_cable::generator
