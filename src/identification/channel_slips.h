// Slips of calibration: channels with a wrong zero, sign, scale, unit or axis, and records that
// begin elsewhere than the set says. What would fit is suggested, never applied. Both end after
// `seconds`.
#pragma once

#include <vector>

#include "cosserat_cable/identification/estimation.h"

namespace cosserat_cable {

/// Looks through the records that the fit leaves far above their noise. Told is a slip that
/// explains nearly all of that with the cable's parameters free, and the simplest of those that do.
/// In `mended`, a copy of the set, what is found of what acts on the cable is mended.
std::vector<ChannelSlip> FindSlips(const MeasurementSet& set, const Estimation& fit,
                                   const EstimationOptions& options, double seconds,
                                   MeasurementSet* mended);

/// Marks the parameters that would be others with the fit's slips mended, and without the records
/// that were recorded with a slip; with those mended where no others tell.
void DoubtSlips(const MeasurementSet& mended, const Unknowns& unknowns,
                const EstimationOptions& options, double seconds, Estimation* fit);

/// Times in milliseconds, micro- or nanoseconds instead of seconds: samples so far apart that they
/// show no swing of the set's cable, and a record that a factor would make a good one. Such a set
/// cannot be simulated; they are problems.
void CheckClocks(const MeasurementSet& set, Problems* problems);

}  // namespace cosserat_cable
