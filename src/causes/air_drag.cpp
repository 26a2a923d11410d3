// `air_drag`: the pressure drag of air at rest in the world.
#include <cmath>

#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {
namespace {

constexpr double kAirDensity = 1.204;  // [kg/m^3], dry, at 20 degrees and 1013 hPa

/// -1/2 rho Cd d |v_n| v_n per length [N/m] with the part v_n of the velocity that is normal to the
/// cable (cross-flow principle: Hoerner, Fluid-Dynamic Drag, 1965, ch. 3), lumped at the nodes.
class AirDrag final : public rod::Load {
 public:
  AirDrag(double per_length, double length) : per_length_(per_length), length_(length) {}

  void Evaluate(const rod::Centreline& rod, rod::LoadSink* sink) const override {
    const int elements = rod.elements();
    const double of_element = per_length_ * length_ / elements;
    double dissipation = 0;
    for (int i = 0; i <= elements; ++i) {
      const double k = i == 0 || i == elements ? 0.5 * of_element : of_element;  // [kg/m]
      const Vec3<double> v = rod.velocity(i);
      const Quat<double> q = rod.orientation(i);
      const Vec3<double> a3{2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x),
                            1 - 2 * (q.x * q.x + q.y * q.y)};
      const Vec3<double> normal = v - Dot(v, a3) * a3;
      const double speed = std::sqrt(Dot(normal, normal));
      const double along = k * speed, radial = speed > 0 ? k / speed : 0.0;
      Mat3<double> by_velocity = along * Outer(a3, a3) - radial * Outer(normal, normal);
      for (int j = 0; j < 3; ++j) by_velocity[j][j] -= along;
      sink->AddNodeForce(i, -along * normal, {}, by_velocity);
      dissipation += along * speed * speed;
    }
    sink->AddDissipation(dissipation);
  }
  double Energy(const rod::Centreline&) const override { return 0; }
  bool ActsAtRest() const override { return false; }

 private:
  double per_length_, length_;  // [kg/m^2], [m]
};

std::shared_ptr<const rod::Load> MakeLoad(const CableExtension& extension,
                                          const CableModel& cable) {
  const double Cd = extension.parts.front().at("Cd");
  if (Cd == 0) return nullptr;
  return std::make_shared<AirDrag>(0.5 * kAirDensity * Cd * cable.diameter, cable.length);
}

}  // namespace

Cause AirDragCause() {
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "air_drag";
  law.shape = "a coefficient {Cd: ...}";
  law.fields = {{"Cd", "", NumberSpec::AtLeast(0, "").AtMost(1000)}};
  law.load = MakeLoad;
  cause.name = law.name;
  cause.words = "air drag that grows with the square of the velocity";
  using Role = HypothesisNumber::Role;
  cause.hypotheses = {{{{{"extensions.air_drag.Cd", Role::kSize, 1, NumberScale::kOne}}}}};
  return cause;
}

}  // namespace cosserat_cable
