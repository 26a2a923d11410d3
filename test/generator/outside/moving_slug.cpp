// A slug of `mass` in a hose slides to and fro along it, once in `period`; it hangs on the axis by
// a spring and dashpot that give way by little (`frequency` [rad/s], far above the rod's own).

#include "../noise.h"
#include "follower.h"
#include "kinds.h"
#include "patch.h"

namespace cosserat_cable::generator {
namespace {

constexpr double kRatio = 0.4;  // of its dashpot
const Eigen::Vector3d kWeight(0.0, 0.0, -9.81);

class MovingSlug : public Effect {
 public:
  MovingSlug(double mass, double period, double phase, double w, double length)
      : mass_(mass), period_(period), phase_(phase), length_(length), slug_(w, kRatio, kWeight) {}
  int stations() const override { return Patch::kStations; }
  void addForces(const StationState& at, Points* force) const override {
    const Patch patch = place(at.t);
    if (at.settled || slug_.empty()) {
      patch.add(at.s, mass_ * kWeight, force);
      return;
    }
    const Points r = patch.mean(at.s, at.position), v = velocity(at, patch);
    patch.add(at.s, -mass_ * slug_.pull(slug_.at(at.t, r, v), r, v).col(0), force);
  }
  void commitLoads(const StationState& at) override {
    const Patch patch = place(at.t);
    slug_.commit(at.t, patch.mean(at.s, at.position), velocity(at, patch), at.settled);
  }

 private:
  double turn() const { return 2.0 * std::acos(-1.0) / period_; }
  Patch place(double t) const {
    return {length_ * (0.5 - 0.38 * std::cos(turn() * t + phase_)), 0.1 * length_};
  }
  /// Of the place on the axis where the slug is, which it slides along.
  Points velocity(const StationState& at, const Patch& patch) const {
    const double slides =
        at.settled ? 0.0 : 0.38 * length_ * turn() * std::sin(turn() * at.t + phase_);
    return patch.mean(at.s, at.velocity) + slides * patch.mean(at.s, at.tangent);
  }

  double mass_, period_, phase_, length_;
  Follower slug_;
};

EffectValues defaults(const EffectScale& scale, double size) {
  return {{"mass", 0.06 * size * scale.cable.rhoA * scale.cable.length},
          {"period", 1.3},
          {"frequency", 8.0 * scale.frequency},
          {"seed", 1.0}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  Random random(static_cast<std::uint64_t>(valueOf(values, "seed")));
  const double period = random.uniform(0.7, 1.4) * valueOf(values, "period");
  const double phase = random.uniform(0.0, 6.28);
  return std::make_unique<MovingSlug>(valueOf(values, "mass"), period, phase,
                                      valueOf(values, "frequency"), site.cable.length);
}

}  // namespace

const EffectKind kMovingSlug = {"moving_slug", "outside.moving_slug", defaults, make};

}  // namespace cosserat_cable::generator
