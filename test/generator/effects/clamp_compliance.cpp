// extensions.clamp_compliance: rotation springs at the clamps a and b; a stiffness of 0 here stands
// for a clamp that is rigid. The section at end a has rotations of its own against the clamp.

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class ClampCompliance : public Effect {
 public:
  explicit ClampCompliance(const EffectValues& values) {
    for (int end = 0; end < 2; ++end) {
      const std::string prefix = end == 0 ? "a." : "b.";
      bending_[end] = valueOf(values, prefix + "bending");
      torsion_[end] = valueOf(values, prefix + "torsion");
    }
  }
  bool bendsClamp(int end) const override { return bending_[end] > 0.0; }
  bool twistsClamp(int end) const override { return torsion_[end] > 0.0; }
  void addClampMoment(int end, const ClampTurn& turn, Eigen::Vector3d* moment) const override {
    *moment +=
        Eigen::Vector3d(bending_[end], bending_[end], torsion_[end]).cwiseProduct(turn.angle);
  }

 private:
  double bending_[2], torsion_[2];  // [N m/rad]
};

EffectValues defaults(const EffectScale& scale, double size) {
  const double L = scale.cable.length;
  return {{"a.bending", clampStiffness(scale.cable.EI / L, 0.012 * size)},
          {"a.torsion", clampStiffness(scale.cable.GJ / L, 0.03 * size)},
          {"b.bending", 0.0},
          {"b.torsion", 0.0}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite&) {
  return std::make_unique<ClampCompliance>(values);
}

}  // namespace

const EffectKind kClampCompliance = {"clamp_compliance", "extensions.clamp_compliance", defaults,
                                     make};

}  // namespace cosserat_cable::generator
