// A magnet beside clamp a's axis brakes what of the rod comes near it: linear damping at `rate` on
// the outer part of the length, in parts of exp(-(distance/reach)^2/2) from the magnet across the
// axis, against the clamp's frame.

#include "kinds.h"
#include "patch.h"

namespace cosserat_cable::generator {
namespace {

class EddyDamping : public Effect {
 public:
  EddyDamping(double factor, double from, const Eigen::Vector2d& magnet, double reach)
      : factor_(factor), from_(from), magnet_(magnet), reach_(reach) {}
  int stations() const override { return 48; }
  void addForces(const StationState& at, Points* force) const override {
    if (at.settled) return;
    for (int i = 0; i < force->cols(); ++i) {
      if (at.s[i] < from_) continue;
      const RelativeMotion motion(at.clamp, at.position.col(i), at.velocity.col(i));
      const double x = (motion.x.head<2>() - magnet_).norm() / reach_;
      force->col(i) -= factor_ * std::exp(-0.5 * x * x) * (at.clamp.R * motion.v);
    }
  }

 private:
  double factor_, from_;  // [kg/(m s)], [m]
  Eigen::Vector2d magnet_;
  double reach_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  const double swing = scale.amplitude * scale.cable.length;
  return {{"rate", 0.2 * size * scale.frequency},
          {"from", 0.6},
          {"x", 0.5 * swing * std::cos(scale.azimuth)},
          {"y", 0.5 * swing * std::sin(scale.azimuth)},
          {"reach", 0.35 * swing}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  return std::make_unique<EddyDamping>(
      site.cable.rhoA * valueOf(values, "rate"), valueOf(values, "from") * site.cable.length,
      Eigen::Vector2d(valueOf(values, "x"), valueOf(values, "y")), valueOf(values, "reach"));
}

}  // namespace

const EffectKind kEddyDamping = {"eddy_damping", "outside.eddy_damping", defaults, make};

}  // namespace cosserat_cable::generator
