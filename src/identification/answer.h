// What cable_identify leaves behind, as text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cosserat_cable/identification/estimation.h"

namespace cosserat_cable {

/// identification.json.
nlohmann::json AnswerJson(const MeasurementSet& set, const Estimation& estimation);

/// What was done in how long, in the answer.
void TellTimes(double seconds, const std::vector<StageCost>& stages, nlohmann::json* answer);

/// fit/NAME.csv: the record's columns, and beside each the simulated one (COLUMN.fit).
std::string FitCsv(const Experiment& experiment, const ExperimentFit& fit);

/// A table for the terminal.
std::string AnswerTable(const MeasurementSet& set, const Estimation& estimation);

}  // namespace cosserat_cable
