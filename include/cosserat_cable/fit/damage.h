// What makes a record unfit to be measured from.
#pragma once

#include <Eigen/Core>
#include <string>

#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Per sample and channel one for what a sensor measured, zero for stretches in which it stood
/// still or was at its limit. A sensor that stands still to the end of its record may show rest.
Eigen::MatrixXd UsableSamples(const Record& record);

/// Why the record is not to be trusted as a whole: a stretch without samples, or too many samples
/// that are not usable. Empty where nothing is wrong.
std::string DamageOf(const Record& record, const Eigen::MatrixXd& usable);

/// The slowest free swing that the experiment's rig has with this cable, roughly [s]; 0 where a
/// clamp drives it, or nothing moves in time.
double SlowestPeriod(const Experiment& experiment, const CableModel& cable);
/// The same whether a clamp drives it or not: of the rig with its clamps still.
double RigPeriod(const Experiment& experiment, const CableModel& cable);

}  // namespace cosserat_cable
