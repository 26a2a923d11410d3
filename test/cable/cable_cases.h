// Cables that several tests share.
#pragma once

#include <cmath>

#include "cosserat_cable/cable/cable_model.h"

namespace cosserat_cable {

/// Round isotropic cable with the measurement format's defaults: EA = 16 EI/d^2, GA = EA/3,
/// critical damping of stretching and shearing; eta_GJ = eta_EI/2.
inline CableModel RoundCableModel(double length, double diameter, double mass_per_length, double EI,
                                  double GJ, double eta_EI) {
  CableModel m;
  m.length = length;
  m.diameter = diameter;
  m.mass_per_length = mass_per_length;
  m.EI1 = m.EI2 = EI;
  m.GJ = GJ;
  m.EA = 16 * EI / (diameter * diameter);
  m.GA1 = m.GA2 = m.EA / 3;
  m.eta_EI1 = m.eta_EI2 = eta_EI;
  m.eta_GJ = eta_EI / 2;
  m.eta_EA = 4 * length / M_PI * std::sqrt(mass_per_length * m.EA);
  m.eta_GA1 = m.eta_GA2 = 2 * std::sqrt(m.rhoI() * m.GA1);
  m.apex_s = 0.5 * length;
  return m;
}

}  // namespace cosserat_cable
