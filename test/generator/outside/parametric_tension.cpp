// A thread pulls the end towards an anchor far along clamp a's axis with a tension that pulsates:
// from nothing at the record's start to `tension`, at `frequency`.

#include "../noise.h"
#include "kinds.h"
#include "patch.h"

namespace cosserat_cable::generator {
namespace {

const double kPi = std::acos(-1.0);

class ParametricTension : public Effect {
 public:
  ParametricTension(double tension, double frequency, double length)
      : tension_(tension),
        frequency_(frequency),
        length_(length),
        end_(0.9 * length, 0.1 * length) {}
  int stations() const override { return Patch::kStations; }
  void addForces(const StationState& at, Points* force) const override {
    constexpr double kAnchor = 2.5;  // lengths from the clamp
    if (at.settled) return;
    const double s = std::sin(kPi * frequency_ * at.t);
    const Eigen::Vector3d anchor = at.clamp.p + kAnchor * length_ * at.clamp.R.col(2);
    const Eigen::Vector3d way = anchor - end_.mean(at.s, at.position);
    end_.add(at.s, tension_ * s * s * way.normalized(), force);
  }

 private:
  double tension_, frequency_, length_;
  Patch end_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  const CableData& c = scale.cable;
  return {{"tension", 0.15 * size * c.EI / (c.length * c.length)},
          {"frequency", 0.15 * scale.frequency},
          {"seed", 1.0}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  Random random(static_cast<std::uint64_t>(valueOf(values, "seed")));
  const double factor = random.uniform(0.5, 1.5);
  return std::make_unique<ParametricTension>(
      valueOf(values, "tension"), factor * valueOf(values, "frequency"), site.cable.length);
}

}  // namespace

const EffectKind kParametricTension = {"parametric_tension", "outside.parametric_tension", defaults,
                                       make};

}  // namespace cosserat_cable::generator
