// extensions.clamp_damping: dashpots beside the springs of clamp_compliance; b.torsion of a
// specimen with a disc is the loss D_E against the world.

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class ClampDamping : public Effect {
 public:
  ClampDamping(const EffectValues& values, bool disc) : disc_(disc) {
    for (int end = 0; end < 2; ++end) {
      const std::string prefix = end == 0 ? "a." : "b.";
      bending_[end] = valueOf(values, prefix + "bending");
      torsion_[end] = valueOf(values, prefix + "torsion");
    }
  }
  bool bendsClamp(int end) const override { return bending_[end] > 0.0; }
  bool twistsClamp(int end) const override { return torsion_[end] > 0.0 && !(end == 1 && disc_); }
  void addClampMoment(int end, const ClampTurn& turn, Eigen::Vector3d* moment) const override {
    *moment += Eigen::Vector3d(bending_[end], bending_[end], torsion_[end]).cwiseProduct(turn.rate);
  }
  double discDashpot() const override { return disc_ ? torsion_[1] : 0.0; }

 private:
  bool disc_;
  double bending_[2], torsion_[2];  // [N m s/rad]
};

EffectValues defaults(const EffectScale& scale, double size) {
  // Relative to a spring that gives way by a few parts in a hundred: the loss is the product.
  const double L = scale.cable.length;
  const double bending = clampStiffness(scale.cable.EI / L, 0.012 * size);
  const double torsion = clampStiffness(scale.cable.GJ / L, 0.03 * size);
  return {{"a.bending", size == 0.0 ? 0.0 : 0.7 * bending / scale.frequency},
          {"a.torsion", size == 0.0 ? 0.0 : 0.7 * torsion / scale.torsion},
          {"b.bending", 0.0},
          {"b.torsion", 0.0}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  return std::make_unique<ClampDamping>(values, site.disc);
}

}  // namespace

const EffectKind kClampDamping = {"clamp_damping", "extensions.clamp_damping", defaults, make};

}  // namespace cosserat_cable::generator
