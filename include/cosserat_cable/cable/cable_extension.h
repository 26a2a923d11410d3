// A law beside the rigidly clamped Kelvin-Voigt rod, as a cable's file says it.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace cosserat_cable {

/// Path, in `clamp_damping`, of the loss D_E at a disc that turns freely at end b.
inline constexpr const char* kDiscDashpot = "b.torsion";

/// One entry of a cable's `extensions`: its name, and its numbers in SI units with all defaults
/// filled in. config/cables/template.yaml says what there is and what each number means.
struct CableExtension {
  std::string name;  ///< "maxwell"
  /// Numbers by their path in the entry: "tau", "a.bending". A key that may be given for both
  /// directions at once is here as two, "EI1" and "EI2". One map, or one per item of a list.
  std::vector<std::map<std::string, double>> parts;
};

}  // namespace cosserat_cable
