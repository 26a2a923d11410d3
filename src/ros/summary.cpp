#include "cosserat_cable/ros/summary.h"

#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "cosserat_cable/cable/contact_stiffness.h"
#include "cosserat_cable/console/output_file.h"
#include "cosserat_cable/input/gravity.h"
#include "json.h"

namespace cosserat_cable {
namespace {

std::string Format(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string Millimetres(double metres) {
  return std::isfinite(metres) ? Format("%.2f", 1e3 * metres) : std::string("-");
}

// A cable that loses less did not sway: its residual is rounding, and of the clamps' interpolated
// speed, which a travelling cable follows with all of its kinetic energy.
constexpr double kNothingLost = 1e-9;          // [J]
constexpr double kNothingLostOfTravel = 1e-5;  // of the kinetic energy

// A wire that is pulled taut within a step may lack 5 %; more is no simulation of the cable.
constexpr double kLacksTooMuch = 0.1;
// What is lacking counts as damping that nobody put in.
constexpr double kLacksToBeTold = 0.02;

/// The balance's residual as a share of what was dissipated; negative where nothing was.
double EnergyError(const CableSummary& cable) {
  if (!(cable.dissipated > kNothingLost + kNothingLostOfTravel * cable.kinetic_max)) return -1;
  return std::abs(cable.energy_residual) / cable.dissipated;
}

std::string EnergyColumn(const CableSummary& cable) {
  const double error = EnergyError(cable);
  return error < 0 ? "-" : Format("%.3f", 100 * error) + "%";
}

/// How far the balance is off, and what that is relative to; "" where it is not worth a word.
std::string EnergyRemark(const CableSummary& cable) {
  const double error = EnergyError(cable);
  if (!(error > kLacksToBeTold)) return "";
  std::string text = "its energy balance is off by " + Format("%.3g", cable.energy_residual) +
                     " J, " + Format("%.0f", 100 * error) + " % of what was dissipated";
  // A stiff cable that travels with its clamps dissipates next to nothing of what it is given.
  if (cable.kinetic_max > 0)
    text += " (" + Format("%.2g", 100 * std::abs(cable.energy_residual) / cable.kinetic_max) +
            " % of its largest kinetic energy)";
  if (error > kLacksTooMuch)
    return "warning: " + text +
           ": do not rely on its damping; try shorter steps (--dt; half of one leaves a quarter) "
           "or "
           "another number of elements";
  return "note: " + text +
         ": that acts as damping that nobody put in; shorter steps (--dt) make it less, half of "
         "one "
         "a quarter";
}

}  // namespace

std::string CableSummary::DepthWarning() const {
  if (!(stiffness_needed > 0)) return "";
  char text[400];
  std::snprintf(
      text, sizeof text,
      "sinks %.3g mm into '%s', %.0f %% of its radius (at s = %.3g m, %.3f s): its contact "
      "forces are too small; with `contact: {stiffness: %.1e}` instead of %.2g N/m it "
      "would stay within %.0f %%",
      1e3 * penetration_max, penetration_body.c_str(), 100 * penetration_max / radius,
      penetration_s, 1e-9 * static_cast<double>(penetration_time), stiffness_needed,
      contact_stiffness, 100 * kDeepestShareOfRadius);
  return text;
}

std::string Summary::ToText() const {
  std::ostringstream text;
  text << "simulated " << Format("%.3f", simulated_time) << " s in " << Format("%.2f", wall_time)
       << " s: real-time factor " << Format("%.2f", real_time_factor()) << ", peak memory "
       << Format("%.0f", peak_memory / 1e6) << " MB\n";
  text << "inertial frame '" << world_frame << "', " << GravityText(gravity_W, world_frame) << "\n";
  if (use_record_times) text << "times are those of recording, not the messages' stamps\n";
  char line[240];
  std::snprintf(line, sizeof line, "%-28s %11s %12s %12s %10s %10s %9s %8s\n", "cable", "amplitude",
                "curvature", "clearance", "contact", "tension", "energy", "retries");
  text << line;
  std::snprintf(line, sizeof line, "%-28s %11s %12s %12s %10s %10s %9s\n", "", "max [mm]",
                "max [1/m]", "min [mm]", "max [N]", "max [N]", "off by");
  text << line;
  for (const CableSummary& cable : cables) {
    std::snprintf(
        line, sizeof line, "%-28s %11s %12s %12s %10s %10s %9s %8llu\n", cable.name.c_str(),
        Millimetres(cable.amplitude_max).c_str(), Format("%.2f", cable.curvature_max).c_str(),
        (cable.bodies > 0 ? Millimetres(cable.clearance_min) : "no body").c_str(),
        Format("%.2f", cable.contact_force_max).c_str(), Format("%.2f", cable.tension_max).c_str(),
        EnergyColumn(cable).c_str(), static_cast<unsigned long long>(cable.retried_steps));
    text << line;
    if (cable.stiffness_needed > 0) text << "  warning: " << cable.DepthWarning() << "\n";
    if (!cable.long_elements.empty()) text << "  warning: " << cable.long_elements << "\n";
    if (!cable.rest_remark.empty()) text << "  warning: " << cable.rest_remark << "\n";
    if (const std::string remark = EnergyRemark(cable); !remark.empty())
      text << "  " << remark << "\n";
    if (!cable.failure.empty()) text << "  FAILED: " << cable.failure << "\n";
  }
  if (!cables.empty())
    text << "energy off by: what each cable's energies do not add up to, in % of what the cable "
            "dissipated; -: it dissipated nothing to speak of\n";
  if (resets > 0)
    text << "the cables settled anew " << resets
         << " times: time ran backwards or jumped, or frames changed\n";
  if (gaps > 0) text << "gaps in the input: " << gaps << " (held, flagged in the telemetry)\n";
  if (smooth > 0) text << "links smoothed by a low-pass of " << Format("%g", smooth) << " Hz\n";
  for (const std::string& warning : warning_sentences) text << "warning: " << warning << "\n";
  for (const Finding& finding : findings) text << "warning: " << finding.ToString() << "\n";
  for (const std::string& note : notes) text << "note: " << note << "\n";
  return text.str();
}

std::string Summary::ToJson() const {
  std::ostringstream json;
  json << "{\n  \"simulated_time\": " << JsonNumber(simulated_time)
       << ",\n  \"wall_time\": " << JsonNumber(wall_time)
       << ",\n  \"real_time_factor\": " << JsonNumber(real_time_factor())
       << ",\n  \"peak_memory\": " << JsonNumber(peak_memory)
       << ",\n  \"gravity\": " << JsonVector(gravity_W)
       << ",\n  \"use_record_times\": " << (use_record_times ? "true" : "false")
       << ",\n  \"notes\": " << JsonStrings(notes)
       << ",\n  \"world_frame\": " << JsonString(world_frame) << ",\n  \"resets\": " << resets
       << ",\n  \"gaps\": " << gaps << ",\n  \"warnings\": {";
  const char* separator = "";
  for (const auto& [kind, count] : warnings) {
    json << separator << "\n    " << JsonString(kind) << ": " << count;
    separator = ",";
  }
  json << (warnings.empty() ? "}" : "\n  }")
       << ",\n  \"warning_sentences\": " << JsonStrings(warning_sentences)
       << ",\n  \"smooth\": " << JsonNumber(smooth)
       << ",\n  \"findings\": " << JsonFindings(findings) << ",\n  \"cables\": {";
  separator = "";
  for (const CableSummary& cable : cables) {
    json << separator << "\n    " << JsonString(cable.name) << ": {\"steps\": " << cable.steps
         << ", \"retried_steps\": " << cable.retried_steps
         << ", \"iterations\": " << cable.iterations
         << ", \"amplitude_max\": " << JsonNumber(cable.amplitude_max)
         << ", \"curvature_max\": " << JsonNumber(cable.curvature_max)
         << ", \"clearance_min\": " << JsonNumber(cable.clearance_min)
         << ", \"bodies\": " << cable.bodies << ", \"long_elements\": "
         << (cable.long_elements.empty() ? "null" : JsonString(cable.long_elements))
         << ", \"rest_remark\": "
         << (cable.rest_remark.empty() ? "null" : JsonString(cable.rest_remark))
         << ", \"contact_stiffness\": " << JsonNumber(cable.contact_stiffness)
         << ", \"penetration_max\": " << JsonNumber(cable.penetration_max)
         << ", \"penetration_share_of_radius\": "
         << JsonNumber(cable.radius > 0 ? cable.penetration_max / cable.radius : 0)
         << ", \"penetration_body\": "
         << (cable.penetration_body.empty() ? "null" : JsonString(cable.penetration_body))
         << ", \"penetration_s\": "
         << (cable.penetration_body.empty() ? "null" : JsonNumber(cable.penetration_s))
         << ", \"penetration_time\": "
         << (cable.penetration_body.empty()
                 ? "null"
                 : JsonNumber(1e-9 * static_cast<double>(cable.penetration_time)))
         << ", \"contact_stiffness_needed\": "
         << (cable.stiffness_needed > 0 ? JsonNumber(cable.stiffness_needed) : "null")
         << ", \"contact_force_max\": " << JsonNumber(cable.contact_force_max)
         << ", \"tension_max\": " << JsonNumber(cable.tension_max) << JsonClamps(cable.clamps)
         << ", \"dissipated\": " << JsonNumber(cable.dissipated)
         << ", \"energy_residual\": " << JsonNumber(cable.energy_residual)
         << ", \"energy_off_by\": "
         << (EnergyError(cable) < 0 ? "null" : JsonNumber(EnergyError(cable)))
         << ", \"kinetic_max\": " << JsonNumber(cable.kinetic_max) << ", \"failure\": "
         << (cable.failure.empty() ? std::string("null") : JsonString(cable.failure)) << "}";
    separator = ",";
  }
  json << "\n  }\n}\n";
  return json.str();
}

double PeakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024;
}

bool WriteTextFile(const std::string& path, const std::string& text) {
  try {
    WriteWhole(path, text);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace cosserat_cable
