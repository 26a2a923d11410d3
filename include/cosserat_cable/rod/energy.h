// Where a rod's energy comes from and goes.
#pragma once

namespace cosserat_cable::rod {

/// Since a state at rest (or in rigid motion), all in J. What a simulation makes or loses by itself
/// shows in the residual.
struct EnergyBalance {
  double work_ends = 0;     ///< by both clamps on the rod and on their own springs
  double work_loads = 0;    ///< by loads other than gravity, but for what they dissipate
  double dissipated = 0;    ///< in the sections, the clamps and the loads
  double stored = 0;        ///< change of the kinetic, elastic and gravity energy
  double work_section = 0;  ///< by changes of the section's parameters at the strains of the time

  double Residual() const { return work_ends + work_loads + work_section - stored - dissipated; }
};

}  // namespace cosserat_cable::rod
