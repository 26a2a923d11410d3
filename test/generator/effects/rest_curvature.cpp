// extensions.rest_curvature: the moments vanish at curvatures k1, k2 and a twist, uniform.

#include "kinds.h"
#include "linear_section.h"

namespace cosserat_cable::generator {
namespace {

class RestCurvature : public LinearSection {
 public:
  RestCurvature(const Eigen::Vector3d& m, double twist)
      : LinearSection(Eigen::Matrix3d::Zero(), m), twist_(twist) {}
  double unstressedTwist() const override { return twist_; }

 private:
  double twist_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  const double unit = size / scale.cable.length;
  return {{"k1", 0.014 * unit}, {"k2", -0.01 * unit}, {"twist", 0.1 * unit}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  const Eigen::Vector3d m(site.cable.EI * valueOf(values, "k1"),
                          site.cable.EI * valueOf(values, "k2"),
                          site.cable.GJ * valueOf(values, "twist"));
  return std::make_unique<RestCurvature>(m, valueOf(values, "twist"));
}

}  // namespace

const EffectKind kRestCurvature = {"rest_curvature", "extensions.rest_curvature", defaults, make};

}  // namespace cosserat_cable::generator
