// The Kelvin-Voigt section law of a cable and its distribution of mass.
#pragma once

#include <Eigen/Core>

namespace cosserat_cable::rod {

/// F = C_F (Gamma - Gamma0) + V_F dGamma/dt and M = C_M (K - K0) + V_M dK/dt, components along the
/// section's axes a1, a2, a3 (Linn, Lang and Tuganov 2013).
struct Section {
  Eigen::Vector3d C_F;   ///< GA1, GA2, EA [N]
  Eigen::Vector3d C_M;   ///< EI1, EI2, GJ [N m^2]
  Eigen::Vector3d V_F;   ///< eta_GA1, eta_GA2, eta_EA [N s]
  Eigen::Vector3d V_M;   ///< eta_EI1, eta_EI2, eta_GJ [N m^2 s]
  double rhoA = 0;       ///< mass per length [kg/m]
  Eigen::Vector3d rhoJ;  ///< rotary inertia per length about a1, a2, a3 [kg m]
  Eigen::Vector3d gamma0 = Eigen::Vector3d::UnitZ();  ///< unstressed strain [1]
  Eigen::Vector3d kappa0 = Eigen::Vector3d::Zero();   ///< unstressed curvature and twist [1/m]
};

}  // namespace cosserat_cable::rod
