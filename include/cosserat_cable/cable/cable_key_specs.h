// The ranges of a cable's numbers: wide enough for a bare wire and for a submarine cable, narrow
// enough to catch most slips of units.
#pragma once

#include "cosserat_cable/input/number_spec.h"

namespace cosserat_cable {

inline NumberSpec LengthSpec() { return NumberSpec::Above(0, "m").AtMost(20).Hint("is it in mm?"); }
inline NumberSpec DiameterSpec() {
  return NumberSpec::Above(0, "m").AtMost(0.2).Hint("is it in mm?");
}
inline NumberSpec MassPerLengthSpec() {
  return NumberSpec::Above(0, "kg/m").AtMost(50).Hint("is it in g/m?");
}
/// Bending and torsion.
inline NumberSpec BendingStiffnessSpec() {
  return NumberSpec::Above(0, "N m^2").AtMost(1e5).Hint("is it in N mm^2?");
}
/// Extension and shear; 1e10 N is a steel bar of 0.25 m.
inline NumberSpec AxialStiffnessSpec() { return NumberSpec::Above(0, "N").AtMost(1e10); }
/// Of a branch beside the section's own stiffness, which may leave a component out.
inline NumberSpec BranchBendingStiffnessSpec() {
  return NumberSpec::AtLeast(0, "N m^2").AtMost(1e5).Hint("is it in N mm^2?");
}
inline NumberSpec BranchAxialStiffnessSpec() { return NumberSpec::AtLeast(0, "N").AtMost(1e10); }
inline NumberSpec BendingDampingSpec() { return NumberSpec::AtLeast(0, "N m^2 s"); }
inline NumberSpec AxialDampingSpec() { return NumberSpec::AtLeast(0, "N s"); }
inline NumberSpec ArcLengthSpec() {
  return NumberSpec::AtLeast(0, "m").AtMost(20).Hint("is it in mm?");
}
inline NumberSpec LumpedMassSpec() {
  return NumberSpec::Above(0, "kg").AtMost(100).Hint("is it in g?");
}
inline NumberSpec ContactStiffnessSpec() { return NumberSpec::Above(0, "N/m").AtMost(1e9); }
inline NumberSpec ContactSmoothingSpec() {
  return NumberSpec::AtLeast(0, "m").AtMost(0.01).Hint("is it in mm?");
}
inline NumberSpec ContactDampingSpec() { return NumberSpec::AtLeast(0, "s/m"); }

}  // namespace cosserat_cable
