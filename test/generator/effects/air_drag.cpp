// extensions.air_drag: -1/2 rho Cd d |v_n| v_n per length, v_n the part of the world velocity
// across the axis, at stations that are not the rod's own nodes.

#include <algorithm>

#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

constexpr double kAir = 1.204;  // [kg/m^3]

class AirDrag : public Effect {
 public:
  explicit AirDrag(double factor) : factor_(factor) {}
  int stations() const override { return 24; }
  void addForces(const StationState& at, Points* force) const override {
    for (int i = 0; i < force->cols(); ++i) {
      const Eigen::Vector3d axis = at.tangent.col(i).normalized();
      const Eigen::Vector3d v = at.velocity.col(i);
      const Eigen::Vector3d across = v - axis.dot(v) * axis;
      force->col(i) -= factor_ * across.norm() * across;
    }
  }

 private:
  double factor_;  // [kg/m^2]
};

EffectValues defaults(const EffectScale& scale, double size) {
  // Takes a third of the larger ring-down's amplitude in ten swings, small ones hardly show it.
  // What that takes of a thick cable no cylinder has (Cd 1 to 2): the bound keeps it to slender
  // ones.
  constexpr double kLargest = 60.0;
  const CableData& c = scale.cable;
  const double Cd = 0.1 * c.rhoA / (kAir * c.diameter * scale.amplitude * c.length);
  return {{"Cd", size * std::min(kLargest, Cd)}};
}

std::unique_ptr<Effect> make(const EffectValues& values, const EffectSite& site) {
  return std::make_unique<AirDrag>(0.5 * kAir * valueOf(values, "Cd") * site.cable.diameter);
}

}  // namespace

const EffectKind kAirDrag = {"air_drag", "extensions.air_drag", defaults, make};

}  // namespace cosserat_cable::generator
