#include "modes_report.h"

#include <cmath>
#include <cstdio>
#include <sstream>

#include "cosserat_cable/input/gravity.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/ros/summary.h"
#include "diagnostics.h"
#include "json.h"

namespace cosserat_cable {
namespace {

constexpr double kTwoPi = 2 * M_PI;

double ShareOf(const rod::Mode& mode) {
  switch (mode.kind) {
    case rod::ModeKind::kInPlane:
      return mode.in_plane;
    case rod::ModeKind::kOutOfPlane:
      return mode.out_of_plane;
    case rod::ModeKind::kTorsion:
      return mode.torsion;
    case rod::ModeKind::kAxial:
      return mode.stretch;
  }
  return 0;
}

std::string JsonRoot(const std::complex<double>& root) {
  return "[" + JsonNumber(root.real()) + ", " + JsonNumber(root.imag()) + "]";
}

void WriteMode(const rod::Mode& mode, std::ostream* json) {
  *json << "{\"frequency\": " << JsonNumber(mode.w / kTwoPi)
        << ", \"frequency_damped\": " << JsonNumber(mode.w_damped() / kTwoPi)
        << ", \"damping_ratio\": " << JsonNumber(mode.zeta)
        << ", \"direction\": " << JsonString(ToString(mode.kind))
        << ", \"unstable\": " << (mode.unstable() ? "true" : "false")
        << ", \"lambda\": " << JsonRoot(mode.lambda) << ", \"second\": " << JsonRoot(mode.second)
        << ",\n         \"kinetic\": {\"in_plane\": " << JsonNumber(mode.in_plane)
        << ", \"out_of_plane\": " << JsonNumber(mode.out_of_plane)
        << ", \"torsion\": " << JsonNumber(mode.torsion)
        << "}, \"elastic\": {\"bending\": " << JsonNumber(mode.bending)
        << ", \"twist\": " << JsonNumber(mode.twist)
        << ", \"stretch\": " << JsonNumber(mode.stretch)
        << ", \"shear\": " << JsonNumber(mode.shear) << "}}";
}

}  // namespace

std::string SettingText(const ModesSetting& setting) {
  // So many fit on a screen; --json has all.
  constexpr std::size_t kMostJoints = 8;
  // Rounding of poses is no position.
  constexpr double kZero = 1e-9;
  std::string text = GravityText(setting.gravity, setting.frame) + "\n";
  if (setting.time) {
    text += "the vehicle is where it was " + FormatRounded(*setting.time, 6) +
            " s after the recording's first sample, at " + StampText(setting.stamp) + "\n";
  }
  std::size_t shown = 0;
  for (const auto& [joint, position] : setting.joints) {
    if (std::abs(position) < kZero) continue;
    if (shown < kMostJoints)
      text += (shown == 0 ? "joints: " : ", ") + joint + " " + FormatRounded(position, 4);
    ++shown;
  }
  if (shown > kMostJoints) text += " and " + std::to_string(shown - kMostJoints) + " more";
  if (shown > 0) text += setting.time ? "\n" : "; all others at zero\n";
  for (const std::string& note : setting.notes) text += "note: " + note + "\n";
  return text;
}

std::string SettingComment(const ModesSetting& setting) {
  std::istringstream lines(SettingText(setting));
  std::string comment;
  for (std::string line; std::getline(lines, line);) comment += "# " + line + "\n";
  return comment;
}

std::string ModesText(const CableModes& cable) {
  std::ostringstream text;
  char line[200];
  std::snprintf(line, sizeof line, "cable '%s': %g mm, %d elements%s\n", cable.model.name.c_str(),
                1e3 * cable.model.length, cable.model.elements,
                cable.touches ? ", touches a body at rest" : "");
  text << line;
  if (!cable.warning.empty()) text << "  warning: " << cable.warning << "\n";
  if (!cable.failure.empty()) {
    text << "  FAILED: " << cable.failure << "\n";
    return text.str();
  }
  std::snprintf(line, sizeof line, "%6s %14s %14s %14s  %s\n", "mode", "undamped [Hz]",
                "damped [Hz]", "damping ratio", "direction");
  text << line;
  for (std::size_t n = 0; n < cable.modes.size(); ++n) {
    const rod::Mode& mode = cable.modes[n];
    char damped[40] = "-";
    if (mode.oscillates()) std::snprintf(damped, sizeof damped, "%.3f", mode.w_damped() / kTwoPi);
    std::snprintf(line, sizeof line, "%6zu %14.3f %14s %14.4f  %s, %.0f %%", n + 1, mode.w / kTwoPi,
                  damped, mode.zeta, ToString(mode.kind), 100 * ShareOf(mode));
    text << line;
    if (mode.unstable()) {
      text << ", UNSTABLE: grows by itself";
    } else if (!mode.oscillates() && mode.w > 0) {
      std::snprintf(line, sizeof line, ", creeps back at %.4g 1/s", -mode.lambda.real());
      text << line;
    }
    text << "\n";
  }
  return text.str();
}

std::string ModesJson(const std::vector<CableModes>& cables, const ModesSetting& setting,
                      double wall_time) {
  std::ostringstream json;
  json << "{\n  \"wall_time\": " << JsonNumber(wall_time)
       << ",\n  \"peak_memory\": " << JsonNumber(PeakMemory())
       << ",\n  \"frame\": " << JsonString(setting.frame)
       << ",\n  \"gravity\": " << JsonVector(setting.gravity)
       << ",\n  \"time\": " << (setting.time ? JsonNumber(*setting.time) : std::string("null"))
       << ",\n  \"stamp_ns\": " << (setting.time ? std::to_string(setting.stamp) : "null")
       << ",\n  \"notes\": " << JsonStrings(setting.notes) << ",\n  \"joints\": {";
  const char* separator = "";
  for (const auto& [joint, position] : setting.joints) {
    json << separator << JsonString(joint) << ": " << JsonNumber(position);
    separator = ", ";
  }
  json << "},\n  \"cables\": {";
  separator = "";
  for (const CableModes& cable : cables) {
    json << separator << "\n    " << JsonString(cable.model.name)
         << ": {\"elements\": " << cable.model.elements
         << ", \"wall_time\": " << JsonNumber(cable.wall_time)
         << ", \"touches\": " << (cable.touches ? "true" : "false") << ", \"warning\": "
         << (cable.warning.empty() ? std::string("null") : JsonString(cable.warning))
         << ", \"failure\": "
         << (cable.failure.empty() ? std::string("null") : JsonString(cable.failure))
         << ",\n      \"modes\": [";
    const char* comma = "";
    for (const rod::Mode& mode : cable.modes) {
      json << comma << "\n        ";
      WriteMode(mode, &json);
      comma = ",";
    }
    json << "]}";
    separator = ",";
  }
  json << "\n  }\n}\n";
  return json.str();
}

std::string ModesCsv(const CableModes& cable) {
  std::ostringstream csv;
  csv << "s,x,y,z";
  for (std::size_t n = 1; n <= cable.modes.size(); ++n)
    for (const char* field : {"ux", "uy", "uz", "rx", "ry", "rz"}) csv << "," << field << n;
  csv << "\n";
  const auto put = [&csv](const Eigen::Vector3d& v) {
    for (int k = 0; k < 3; ++k) csv << "," << FormatNumber(v[k]);
  };
  for (std::size_t i = 0; i < cable.rest.size(); ++i) {
    csv << FormatNumber(cable.model.length * static_cast<double>(i) / cable.model.elements);
    put(cable.rest[i].p);
    for (const rod::Mode& mode : cable.modes) {
      put(mode.displacement[i]);
      put(mode.rotation[i]);
    }
    csv << "\n";
  }
  return csv.str();
}

}  // namespace cosserat_cable
