// Parameters of a cable that change over the time of a record, anew in each: the extension `drift`.
#pragma once

#include <optional>

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/rod/section.h"

namespace cosserat_cable {

/// Relative changes from a record's first instant to its last, linear in time.
struct Drift {
  double EI = 0, eta_EI = 0;  ///< of both directions
  double GJ = 0, eta_GJ = 0;
};

/// Nothing where the cable has none.
std::optional<Drift> DriftOf(const CableModel& cable);

/// The section when a part of the record's time in [0, 1] has passed.
/// @param section at its first instant
rod::Section Drifted(const rod::Section& section, const Drift& drift, double part);

}  // namespace cosserat_cable
