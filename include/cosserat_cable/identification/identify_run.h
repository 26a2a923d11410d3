// Parameters from a measurement set: what the tool cable_identify does.
#pragma once

#include <string>

#include "cosserat_cable/console/exit_code.h"
#include "cosserat_cable/fit/unknowns.h"
#include "cosserat_cable/identification/plan.h"

namespace cosserat_cable {

struct IdentifyRunOptions {
  std::string set;
  std::string output;  ///< folder
  UnknownOptions unknowns;
  bool profiles = true;
  bool use_damaged = false;  ///< see EstimationOptions
  double time_budget = 300;  ///< likewise [s]
  bool slips = true;         ///< likewise
  bool direct = true;        ///< the source paper's evaluation beside the fit
  bool plan = false;
  PlanOptions plan_options;
  bool report = true;
  bool pdf = false;
  std::string report_program;  ///< scripts/identification_report
  std::string json;
};

/// Writes identified_cable.yaml, identification.json, fit/NAME.csv and report.html. Reports
/// problems to stderr.
ExitCode RunIdentify(const IdentifyRunOptions& options);

}  // namespace cosserat_cable
