// How stiff a cable's contact has to be for what the cable can press with.
#pragma once

#include "cosserat_cable/cable/cable_model.h"

namespace cosserat_cable {

/// A cable that is deeper in a body than this share of its radius is not where its contact says it
/// is, and presses with too small a force.
constexpr double kDeepestShareOfRadius = 0.05;

/// The stiffness per contact point [N/m] of a cable whose file gives none, two digits:
///
///     k = F / (0.05 r),  at least 2e4 N/m, at most E r
///     F = 96 EI/L^2 + 10 g rhoA L + F_T
///
/// F [N] is what the cable can plausibly press on one point with. 96 EI/L^2 bends a straight cable,
/// clamped at both ends, sideways by half its length L (192 EI w/L^3 at w = L/2). The weight counts
/// ten times, for shocks. F_T = 4 EA strain w/l is that of a taut cable pressed sideways by
/// w = L/10: l = sqrt(c^2 + 4 w^2) is how long it is then, strain = l/L - 1, at most 1 %, at least
/// 0, and c the distance of the clamps; it is 0 where the clamps are on different links, which
/// say nothing of c. The larger of EI1 and EI2 counts.
///
/// E = 64 EI/(pi d^4) is the modulus of a round bar with this EI: a cable dents its own section
/// before it presses harder than E r per point (of a flat section, the modulus of a rectangular
/// bar, and half its larger side). 2e4 N/m is stiff enough for thin cables.
double DefaultContactStiffness(const CableModel& cable);

/// A stiffness per contact point [N/m], two digits, with which a cable that was `penetration` [m]
/// deep would stay within kDeepestShareOfRadius. The depth goes with 1/k under a given force, and
/// with 1/sqrt(k) in an impact: the larger of both counts. One that was deeper than its radius went
/// through the body rather than being pushed, and its depth says little of the force: it needs
/// DefaultContactStiffness at least. 0 where the depth is within the share.
double SufficientContactStiffness(const CableModel& cable, double penetration);

}  // namespace cosserat_cable
