#include "cosserat_cable/cable/cable_rod.h"

#include "extensions.h"

namespace cosserat_cable {

rod::RodModel MakeRodModel(const CableModel& cable, const Eigen::Vector3d& gravity_W) {
  rod::RodModel rod;
  rod.length = cable.length;
  rod.elements = cable.elements;
  rod.gravity = gravity_W;
  rod::Section& section = rod.section;
  section.C_F = {cable.GA1, cable.GA2, cable.EA};
  section.C_M = {cable.EI1, cable.EI2, cable.GJ};
  section.V_F = {cable.eta_GA1, cable.eta_GA2, cable.eta_EA};
  section.V_M = {cable.eta_EI1, cable.eta_EI2, cable.eta_GJ};
  section.rhoA = cable.mass_per_length;
  section.rhoJ = {cable.rhoI1(), cable.rhoI2(), cable.rhoJ()};
  for (const LumpedMass& m : cable.masses)
    rod.bodies.push_back({m.s, m.mass, Eigen::Vector3d::Zero()});
  EnterExtensions(cable, &rod);
  return rod;
}

}  // namespace cosserat_cable
