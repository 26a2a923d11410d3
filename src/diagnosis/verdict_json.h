// What cable_diagnose leaves behind, as text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cosserat_cable/diagnosis/diagnosis.h"

namespace cosserat_cable {

inline constexpr const char* kBaselineCable = "baseline_cable.yaml";
inline constexpr const char* kExtendedCable = "extended_cable.yaml";
inline constexpr const char* kExtendedMeasurement = "extended_measurement.yaml";

/// verdict.json.
nlohmann::json VerdictJson(const MeasurementSet& set, const Diagnosis& diagnosis);

/// A specimen's file with what was found: baseline_cable.yaml and extended_cable.yaml.
std::string FoundCableText(const MeasurementSet& set, const CableKeys& cable,
                           const std::map<std::string, FoundParameter>& found);

/// fit/NAME.csv: the record's columns, and beside each what the models make of it (COLUMN.plain,
/// COLUMN.extended).
std::string FitCsv(const Experiment& experiment, const RecordView& view);

/// The verdict and the candidates, for the terminal.
std::string VerdictTable(const Diagnosis& diagnosis);

}  // namespace cosserat_cable
