// The bending stiffness switches between EI and EI (1 - loss) at random instants, `rate` a second,
// each time within a few milliseconds; another sequence in each record.

#include <vector>

#include "../noise.h"
#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class IntermittentSlip : public Effect {
 public:
  IntermittentSlip(double loss, double rate, double duration, std::uint64_t seed) : loss_(loss) {
    Random random(seed);
    for (double t = 0.0;;) {
      t -= std::log(1.0 - random.uniform(0.0, 1.0)) / rate;
      if (t > duration) break;
      switches_.push_back(t);
    }
  }
  bool bends() const override { return true; }
  void addMoments(const SectionState& at, Points* M) const override {
    if (at.settled) return;
    M->topRows<2>() -= loss_ * slipped(at.t) * at.K.topRows<2>();
  }

 private:
  /// Between 0 and 1.
  double slipped(double t) const {
    constexpr double kWithin = 4e-3;  // [s]
    double state = 0.0, direction = 1.0;
    for (const double begin : switches_) {
      const double x = std::min(1.0, std::max(0.0, (t - begin) / kWithin));
      state += direction * x * x * (3.0 - 2.0 * x);
      direction = -direction;
    }
    return state;
  }

  double loss_;  // [N m^2]
  std::vector<double> switches_;
};

EffectValues defaults(const EffectScale&, double size) {
  return {{"loss", std::min(0.9, 0.06 * size)}, {"rate", 3.0}, {"seed", 1.0}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  const auto record = static_cast<std::uint64_t>(1e6 * (site.duration + site.cable.length));
  return std::make_unique<IntermittentSlip>(
      valueOf(values, "loss") * site.cable.EI, valueOf(values, "rate"), site.duration,
      static_cast<std::uint64_t>(valueOf(values, "seed")) + record);
}

}  // namespace

const EffectKind kIntermittentSlip = {"intermittent_slip", "outside.intermittent_slip", defaults,
                                      make};

}  // namespace cosserat_cable::generator
