#pragma once

#include <Eigen/Core>
#include <vector>

namespace cosserat_cable::generator {

/// A mass fixed to the rod's axis, without rotary inertia.
struct PointMass {
  double s = 0.0;     ///< [m]
  double mass = 0.0;  ///< [kg]
};

/// A round, straight, uniform rod with Kelvin-Voigt section laws; components about and along
/// {a1, a2, a3}.
struct Rod {
  double length = 0.0;    ///< [m]
  double diameter = 0.0;  ///< [m]
  double rhoA = 0.0;      ///< [kg/m]
  Eigen::Vector3d C_M;    ///< EI, EI, GJ [N m^2]
  Eigen::Vector3d C_F;    ///< GA, GA, EA [N]
  Eigen::Vector3d V_M;    ///< eta_EI, eta_EI, eta_GJ [N m^2 s]
  Eigen::Vector3d V_F;    ///< eta_GA, eta_GA, eta_EA [N s]
  Eigen::Vector3d rhoJ;   ///< rhoI, rhoI, 2 rhoI [kg m]
  std::vector<PointMass> masses;
};

/// What a cable's file states of a rod; the rest follows by the usual defaults.
struct CableData {
  double length = 0.0;    ///< [m]
  double diameter = 0.0;  ///< [m]
  double rhoA = 0.0;      ///< [kg/m]
  double EI = 0.0;        ///< [N m^2]
  double GJ = 0.0;        ///< [N m^2]
  double eta_EI = 0.0;    ///< [N m^2 s]
  double eta_GJ = 0.0;    ///< [N m^2 s]
  std::vector<PointMass> masses;
};

/// EA = 16 EI/d^2, GA = EA/3, both critically damped (eq. 10), rhoI = rhoA d^2/16.
Rod makeRod(const CableData& data);

}  // namespace cosserat_cable::generator
