// A cable file with what was found of a cable.
#pragma once

#include <string>

#include "cosserat_cable/identification/estimation.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// Digits at which a number's standard deviation shows with two.
int DigitsFor(double value, double sd);

/// identified_cable.yaml: a specimen with what was identified, each number with its uncertainty,
/// and with what was not, marked so.
std::string IdentifiedCableText(const MeasurementSet& set, const Estimation& estimation);

}  // namespace cosserat_cable
