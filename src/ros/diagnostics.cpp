#include "diagnostics.h"

#include <cstdio>

namespace cosserat_cable {

using diagnostic_msgs::DiagnosticStatus;

void AddValue(const std::string& key, const std::string& value, DiagnosticStatus* status) {
  diagnostic_msgs::KeyValue pair;
  pair.key = key;
  pair.value = value;
  status->values.push_back(std::move(pair));
}

void AddValue(const std::string& key, double value, DiagnosticStatus* status) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  AddValue(key, std::string(text), status);
}

DiagnosticStatus CableDiagnostics(const CableSummary& cable, bool failed,
                                  const std::string& message, std::uint64_t held) {
  DiagnosticStatus status;
  status.name = "cosserat_cable: " + cable.name;
  status.hardware_id = "none";
  std::string warning = cable.DepthWarning();
  if (warning.empty()) warning = cable.long_elements;
  if (warning.empty()) warning = cable.rest_remark;
  status.level = failed            ? DiagnosticStatus::ERROR
                 : warning.empty() ? DiagnosticStatus::OK
                                   : DiagnosticStatus::WARN;
  status.message = failed || warning.empty() ? message : warning;
  AddValue("steps", static_cast<double>(cable.steps), &status);
  AddValue("retried steps", static_cast<double>(cable.retried_steps), &status);
  AddValue("iterations per step",
           cable.steps > 0
               ? static_cast<double>(cable.iterations) / static_cast<double>(cable.steps)
               : 0.0,
           &status);
  AddValue("held telemetry samples", static_cast<double>(held), &status);
  AddValue("amplitude max [m]", cable.amplitude_max, &status);
  AddValue("curvature max [1/m]", cable.curvature_max, &status);
  AddValue("clearance min [m]", cable.clearance_min, &status);
  AddValue("bodies to avoid", static_cast<double>(cable.bodies), &status);
  AddValue("penetration max [m]", cable.penetration_max, &status);
  AddValue("penetration max [% of radius]",
           cable.radius > 0 ? 100 * cable.penetration_max / cable.radius : 0, &status);
  AddValue("contact force max [N]", cable.contact_force_max, &status);
  AddValue("tension max [N]", cable.tension_max, &status);
  return status;
}

DiagnosticStatus InputDiagnostics(const LinkMotion& links, std::uint64_t resets,
                                  const Findings& findings, double smooth) {
  DiagnosticStatus status;
  status.name = "cosserat_cable: input";
  status.hardware_id = "none";
  const std::uint64_t gaps = links.gap_count();
  const auto& counts = links.warnings().counts();
  const bool clean = gaps == 0 && resets == 0 && counts.empty() && findings.empty();
  status.level = clean ? DiagnosticStatus::OK : DiagnosticStatus::WARN;
  status.message = "all links driven";
  if (!clean) status.message = "the input has faults; see the counts";
  if (!findings.empty()) status.message = findings.front().ToString();
  if (findings.size() > 1)
    status.message += " (and " + std::to_string(findings.size() - 1) + " more, see below)";
  AddValue("world frame", links.world(), &status);
  AddValue("gaps", static_cast<double>(gaps), &status);
  AddValue("resets", static_cast<double>(resets), &status);
  if (smooth > 0) {
    AddValue("smoothed below [Hz]", smooth, &status);
    AddValue("latency of smoothing [s]", EdgeSmoother::Latency(smooth), &status);
  }
  for (const auto& [kind, count] : counts) AddValue(kind, links.warnings().Sentence(kind), &status);
  for (const Finding& finding : findings)
    AddValue(finding.kind + ": " + finding.subject, finding.ToString(), &status);
  return status;
}

}  // namespace cosserat_cable
