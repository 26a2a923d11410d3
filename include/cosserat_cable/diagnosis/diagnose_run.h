// A diagnosis of a measurement set: what the tool cable_diagnose does.
#pragma once

#include <string>

#include "cosserat_cable/console/exit_code.h"

namespace cosserat_cable {

struct DiagnoseRunOptions {
  std::string set;
  std::string output;        ///< folder
  double time_budget = 300;  ///< see DiagnosisOptions [s]
  bool advise = true;        ///< likewise
  bool report = true;
  std::string report_program;  ///< scripts/diagnosis_report
  std::string json;
};

/// Writes verdict.json, fit/NAME.csv and report.html; where causes were named,
/// extended_cable.yaml and extended_measurement.yaml. Reports problems to stderr.
ExitCode RunDiagnose(const DiagnoseRunOptions& options);

}  // namespace cosserat_cable
