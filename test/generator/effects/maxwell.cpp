// extensions.maxwell: one Maxwell branch beside EI and GJ, which stay the stiffness after a long
// rest. A list in the file, hence maxwell[0]. The branch's EA is not covered.

#include "kinds.h"
#include "relaxation.h"

namespace cosserat_cable::generator {
namespace {

EffectValues defaults(const EffectScale& scale, double size) {
  return {{"tau", 1.0 / scale.frequency},
          {"EI", 0.1 * size * scale.cable.EI},
          {"GJ", 0.1 * size * scale.cable.GJ}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite&) {
  const double EI = valueOf(values, "EI");
  return std::make_unique<Relaxation>(std::vector<RelaxingBranch>{
      {valueOf(values, "tau"), Eigen::Vector3d(EI, EI, valueOf(values, "GJ"))}});
}

}  // namespace

const EffectKind kMaxwell = {"maxwell", "extensions.maxwell[0]", defaults, make};

}  // namespace cosserat_cable::generator
