// The smooth normal force between a cable's surface and a body.
#pragma once

namespace cosserat_cable {

/// A penalty with a quadratic smoothing band and Hunt-Crossley damping:
///
///     f = k phi(delta) H(c delta_dot)
///     phi(delta) = 0                       for        delta <= -w/2
///                  (delta + w/2)^2 / (2w)  for -w/2 < delta <  w/2
///                  delta                   for  w/2 <= delta
///     H(u) = u + sqrt(1 + u^2) = exp(asinh(u))
///
/// Penetration delta [m] > 0 overlaps; delta_dot [m/s] is its rate, > 0 when closing. phi is C1.
///
/// Hunt and Crossley (1975, J. Appl. Mech. 42) have H(u) = 1 + u, which is negative, so sticky, for
/// u < -1, and kinked where clamped at zero. This H has the same value and slope at u = 0, so the
/// same restitution 1 - O(c v) at small speeds, and is positive, increasing and smooth for every u.
/// H(u) H(-u) = 1, and (H(u) - 1) u >= 0: damping never feeds in energy. It grows as 2u when
/// closing fast, where theirs grows as u.
struct ContactLaw {
  double stiffness = 2.0e4;  ///< k [N/m] per contact point
  double smoothing =
      1.0e-4;  ///< w [m] >= 0, width of the quadratic band; the force starts at delta = -w/2
  double damping = 0.5;  ///< c [s/m]

  struct Force {
    double value = 0.0;         ///< [N], never negative
    double by_penetration = 0;  ///< d value / d delta [N/m]
    double by_rate = 0;         ///< d value / d delta_dot [N s/m]
  };
  /// @pre penetration is finite or -inf (nothing near), rate is finite
  Force Evaluate(double penetration, double rate) const;
  /// The elastic part's potential [J], for energy minimisation: its derivative is
  /// Evaluate(penetration, 0).value.
  double Energy(double penetration) const;
};

}  // namespace cosserat_cable
