// What cable_diagnose leaves behind, as text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cosserat_cable/diagnosis/diagnosis.h"

namespace cosserat_cable {

inline constexpr const char* kExtendedCable = "extended_cable.yaml";
inline constexpr const char* kExtendedMeasurement = "extended_measurement.yaml";

/// verdict.json.
nlohmann::json VerdictJson(const MeasurementSet& set, const Diagnosis& diagnosis);

/// extended_cable.yaml: a specimen with the plain parameters and the causes' as they were found.
std::string ExtendedCableText(const MeasurementSet& set, const Diagnosis& diagnosis);

/// fit/NAME.csv: the record's columns, and beside each what the models make of it (COLUMN.plain,
/// COLUMN.extended).
std::string FitCsv(const Experiment& experiment, const RecordView& view);

/// The verdict and the candidates, for the terminal.
std::string VerdictTable(const Diagnosis& diagnosis);

}  // namespace cosserat_cable
