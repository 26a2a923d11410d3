// Something taps the rod at s now and then, `rate` a second, across clamp a's axis from any side:
// half a sine of 20 ms each, of `momentum` on average; another sequence in each record.

#include <vector>

#include "../noise.h"
#include "kinds.h"
#include "patch.h"

namespace cosserat_cable::generator {
namespace {

constexpr double kLasts = 0.02;  // [s]

class RandomTaps : public Effect {
 public:
  RandomTaps(double s, double width, double momentum, double rate, double duration,
             std::uint64_t seed)
      : patch_(s, width) {
    Random random(seed);
    for (double t = 0.1;; t += kLasts) {
      t -= std::log(1.0 - random.uniform(0.0, 1.0)) / rate;
      if (t > duration) break;
      const double angle = random.uniform(-kPi, kPi);
      const double force = momentum * random.uniform(0.5, 1.5) * 0.5 * kPi / kLasts;
      taps_.push_back({t, force * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)});
    }
  }
  int stations() const override { return Patch::kStations; }
  void addForces(const StationState& at, Points* force) const override {
    if (at.settled) return;
    for (const Tap& tap : taps_) {
      const double x = (at.t - tap.begin) / kLasts;
      if (x <= 0.0 || x >= 1.0) continue;
      patch_.add(at.s, std::sin(kPi * x) * (at.clamp.R * tap.force), force);
    }
  }

 private:
  const double kPi = std::acos(-1.0);
  struct Tap {
    double begin;
    Eigen::Vector3d force;
  };
  Patch patch_;
  std::vector<Tap> taps_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  const CableData& c = scale.cable;
  const double swing = 0.02 * scale.amplitude * c.length * scale.frequency;  // of the tip [m/s]
  return {{"s", 0.6},
          {"momentum", 0.25 * size * c.rhoA * c.length * swing},
          {"rate", 2.5},
          {"seed", 1.0}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  const double L = site.cable.length;
  const auto record = static_cast<std::uint64_t>(1e6 * (site.duration + L));
  return std::make_unique<RandomTaps>(
      valueOf(values, "s") * L, 0.1 * L, valueOf(values, "momentum"), valueOf(values, "rate"),
      site.duration, static_cast<std::uint64_t>(valueOf(values, "seed")) + record);
}

}  // namespace

const EffectKind kRandomTaps = {"random_taps", "outside.random_taps", defaults, make};

}  // namespace cosserat_cable::generator
