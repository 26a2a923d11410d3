// Slips of calibration: channels with a wrong zero, sign, scale, unit or axis, and records that
// begin elsewhere than the set says. What would fit is suggested, never applied.
#pragma once

#include <optional>
#include <vector>

#include "cosserat_cable/identification/estimation.h"

namespace cosserat_cable {

/// Looks through the records that the fit leaves far above their noise. Told is a slip that
/// explains nearly all of that with the cable's parameters free, and the simplest of those that do.
/// `mended`: the set without slips that hold for all records; not touched where there are none.
std::vector<ChannelSlip> FindSlips(const MeasurementSet& set, const Estimation& fit,
                                   const EstimationOptions& options,
                                   std::optional<MeasurementSet>* mended);

/// Marks the parameters that would be others without what the fit's slips are suspected in: as the
/// other records have them, or with the slip mended where there are none.
void DoubtSlips(const MeasurementSet& mended, const Unknowns& unknowns,
                const EstimationOptions& options, Estimation* fit);

/// Times in milliseconds, micro- or nanoseconds instead of seconds: samples so far apart that they
/// show no swing of the set's cable, and a record that a factor would make a good one. Such a set
/// cannot be simulated; they are problems.
void CheckClocks(const MeasurementSet& set, Problems* problems);

}  // namespace cosserat_cable
