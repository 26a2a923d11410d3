// Whether a cable's elements are short enough for what it carries.
//
// Under a tension T a cable bends over sqrt(EI/T) at its clamps; an element that is longer than
// twice that, T h^2 > 12 EI with some margin, carries the tension, hangs and vibrates as it should,
// but knows of the bending there only its mean: the largest curvature is told too small. An element
// that turns by more than half a radian is no arc any more: lengths and stiffness are in error by
// the fourth power of the angle, 1e-3 and more.
#pragma once

#include <string>

#include "cosserat_cable/cable/cable_model.h"

namespace cosserat_cable {

/// How many elements would do.
struct NeededElements {
  int for_tension = 0, for_curvature = 0;
};

/// Of a cable that carries `tension` [N], at most, and is curved by `curvature` [1/m], at most.
NeededElements ElementsFor(const CableModel& cable, double tension, double curvature);

/// What to say where the cable has fewer: what is not resolved, and how many would do. Empty where
/// its elements are short enough.
std::string TooLongElements(const CableModel& cable, double tension, double curvature);

}  // namespace cosserat_cable
