#include "cosserat_cable/contact/contact_law.h"

#include <cmath>

namespace cosserat_cable {

ContactLaw::Force ContactLaw::Evaluate(double penetration, double rate) const {
  const double into_band = penetration + smoothing / 2;
  if (into_band <= 0) return {};
  const bool in_band = into_band < smoothing;
  const double phi = in_band ? into_band * into_band / (2 * smoothing) : penetration;
  const double slope = in_band ? into_band / smoothing : 1.0;

  const double u = damping * rate;
  const double root = std::sqrt(1 + u * u);
  // u + root would lose all digits at a large negative u.
  const double factor = u >= 0 ? u + root : 1 / (root - u);

  Force force;
  force.value = stiffness * phi * factor;
  force.by_penetration = stiffness * slope * factor;
  force.by_rate = stiffness * phi * damping * factor / root;
  return force;
}

double ContactLaw::Energy(double penetration) const {
  const double into_band = penetration + smoothing / 2;
  if (into_band <= 0) return 0;
  if (into_band < smoothing) {
    return stiffness * into_band * into_band * into_band / (6 * smoothing);
  }
  return stiffness * (penetration * penetration / 2 + smoothing * smoothing / 24);
}

}  // namespace cosserat_cable
