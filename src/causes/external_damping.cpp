// `external_damping`: a loss to the surroundings in proportion to the mass, whatever the frequency.
#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {
namespace {

/// -rhoA c v per length [N/m], lumped at the nodes as the mass is: each mode decays as exp(-c t/2).
class ExternalDamping final : public rod::Load {
 public:
  ExternalDamping(double per_length, double length) : per_length_(per_length), length_(length) {}

  void Evaluate(const rod::Centreline& rod, rod::LoadSink* sink) const override {
    const int elements = rod.elements();
    const double of_element = per_length_ * length_ / elements;
    double dissipation = 0;
    for (int i = 0; i <= elements; ++i) {
      const double c = i == 0 || i == elements ? 0.5 * of_element : of_element;  // [N s/m]
      const Vec3<double> v = rod.velocity(i);
      sink->AddNodeForce(i, -c * v, {}, {{{-c, 0, 0}, {0, -c, 0}, {0, 0, -c}}});
      dissipation += c * Dot(v, v);
    }
    sink->AddDissipation(dissipation);
  }
  double Energy(const rod::Centreline&) const override { return 0; }
  bool ActsAtRest() const override { return false; }

 private:
  double per_length_, length_;  // [N s/m^2], [m]
};

std::shared_ptr<const rod::Load> MakeLoad(const CableExtension& extension,
                                          const CableModel& cable) {
  const double rate = extension.parts.front().at("rate");
  if (rate == 0) return nullptr;
  return std::make_shared<ExternalDamping>(rate * cable.mass_per_length, cable.length);
}

}  // namespace

Cause ExternalDampingCause() {
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = "external_damping";
  law.shape = "a rate {rate: ...}";
  law.fields = {{"rate", "1/s", NumberSpec::AtLeast(0, "1/s").AtMost(1e4)}};
  law.load = MakeLoad;
  cause.name = law.name;
  cause.words = "a loss to the surroundings, linear in the velocity";
  cause.hypotheses = {{{{{"extensions.external_damping.rate"}}}}};
  return cause;
}

}  // namespace cosserat_cable
