// faults.clock: t_record = (1 + scale) t_motion + delay. The motion's time 0 is the release; before
// it the rod is where the start says.

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

class Clock : public Effect {
 public:
  Clock(double scale, double delay) : scale_(scale), delay_(delay) {}
  double motionTime(double t) const override { return (t - delay_) / (1.0 + scale_); }

 private:
  double scale_, delay_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  return {{"scale", 0.006 * size}, {"delay", 0.15 * size / scale.frequency}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite&) {
  return std::make_unique<Clock>(valueOf(values, "scale"), valueOf(values, "delay"));
}

}  // namespace

const EffectKind kClock = {"clock", "faults.clock", defaults, make};

}  // namespace cosserat_cable::generator
