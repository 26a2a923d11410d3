// The smooth normal force between a cable's surface and a body.
#pragma once

namespace cosserat_cable {

/// A penalty with a quadratic smoothing band and Hunt-Crossley damping (Hunt and Crossley 1975):
/// f = k phi(delta) max(0, 1 + c delta_dot)... Penetration delta [m] > 0 overlaps; delta_dot [m/s] is its rate.
struct ContactLaw {
  double stiffness = 2.0e4;   ///< k [N/m] per contact point
  double smoothing = 1.0e-4;  ///< width of the quadratic band [m], centred so that force starts at delta = -smoothing/2
  double damping = 0.5;       ///< c [s/m]

  struct Force {
    double value = 0.0;         ///< [N], never negative
    double by_penetration = 0;  ///< d value / d delta [N/m]
    double by_rate = 0;         ///< d value / d delta_dot [N s/m]
  };
  Force Evaluate(double penetration, double rate) const;
  /// The elastic part's potential [J], for energy minimisation.
  double Energy(double penetration) const;
};

}  // namespace cosserat_cable
