// The rod rubs on a support at s that moves with clamp a: friction across the axis that falls with
// speed v, (slow + (stick - slow) exp(-(v/falls)^2)) tanh(v/onset).

#include "kinds.h"
#include "patch.h"

namespace cosserat_cable::generator {
namespace {

class StribeckSupport : public Effect {
 public:
  StribeckSupport(const EffectValues& v, double length)
      : patch_(valueOf(v, "s") * length, 0.1 * length),
        slow_(valueOf(v, "slow")),
        stick_(valueOf(v, "stick")),
        falls_(valueOf(v, "falls")),
        onset_(valueOf(v, "onset")) {}
  int stations() const override { return Patch::kStations; }
  void addForces(const StationState& at, Points* force) const override {
    if (at.settled) return;
    const RelativeMotion motion(at.clamp, patch_.mean(at.s, at.position),
                                patch_.mean(at.s, at.velocity));
    const Eigen::Vector3d v(motion.v.x(), motion.v.y(), 0.0);
    const double speed = v.norm(), x = speed / falls_;
    if (speed == 0.0) return;
    const double size = (slow_ + (stick_ - slow_) * std::exp(-x * x)) * std::tanh(speed / onset_);
    patch_.add(at.s, at.clamp.R * (-size / speed * v), force);
  }

 private:
  Patch patch_;
  double slow_, stick_;   // [N]
  double falls_, onset_;  // [m/s]
};

EffectValues defaults(const EffectScale& scale, double size) {
  const CableData& c = scale.cable;
  const double force = 3.0 * c.EI / (c.length * c.length) * scale.amplitude;  // of the pull
  const double speed = 0.3 * scale.amplitude * c.length * scale.frequency;    // there
  return {{"s", 0.5},
          {"slow", 0.01 * size * force},
          {"stick", 0.04 * size * force},
          {"falls", 0.15 * speed},
          {"onset", 0.02 * speed}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  return std::make_unique<StribeckSupport>(values, site.cable.length);
}

}  // namespace

const EffectKind kStribeckSupport = {"stribeck_support", "outside.stribeck_support", defaults,
                                     make};

}  // namespace cosserat_cable::generator
