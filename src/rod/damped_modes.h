// What damping makes of the undamped modes.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "linearised_rod.h"
#include "undamped_modes.h"

namespace cosserat_cable::rod {

/// Solutions lambda of (lambda^2 M + K(lambda)) x = 0 that belong to a mode [1/s].
struct ModeRoots {
  std::complex<double> lambda;  ///< carries most of the motion after a release from a pull
  std::complex<double> second;  ///< its conjugate; of a real one, what carries most after a blow
};

/// Roots of the first `count` undamped modes, in their order; no conjugate pair serves twice.
/// `basis`: more undamped modes than that, for first values. False where they do not lead to roots
/// of the whole system one to one: a larger basis helps. `rigid` [1/s]: slower modes are rigid
/// motions, whose roots are zero.
bool FindRoots(const LinearisedRod& rod, const UndampedModes& basis, int count, double rigid,
               std::vector<ModeRoots>* roots);

}  // namespace cosserat_cable::rod
