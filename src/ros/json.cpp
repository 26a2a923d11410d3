#include "json.h"

#include <cmath>
#include <cstdio>

namespace cosserat_cable {
namespace {

std::string Digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

// To the microsecond: nine digits are not enough for today's stamps.
std::string Stamp(std::int64_t stamp) {
  return stamp == 0 ? std::string("null") : Printed("%.6f", static_cast<double>(stamp) * 1e-9);
}

}  // namespace

std::string JsonNumber(double value) {
  return std::isfinite(value) ? Digits(value) : std::string("null");
}

std::string JsonString(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
      quoted += escape;
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string JsonStrings(const std::vector<std::string>& texts) {
  std::string list = "[";
  for (const std::string& text : texts) list += (list.size() > 1 ? ", " : "") + JsonString(text);
  return list + "]";
}

std::string JsonVector(const Eigen::Vector3d& v) {
  return "[" + JsonNumber(v.x()) + ", " + JsonNumber(v.y()) + ", " + JsonNumber(v.z()) + "]";
}

std::string JsonFindings(const Findings& findings) {
  std::string json = "[";
  for (const Finding& finding : findings) {
    json += json.size() > 1 ? ",\n    {" : "\n    {";
    json +=
        "\"kind\": " + JsonString(finding.kind) + ", \"subject\": " + JsonString(finding.subject) +
        ", \"topic\": " + JsonString(finding.topic) +
        ", \"count\": " + std::to_string(finding.count) + ", \"first\": " + Stamp(finding.first) +
        ", \"worst\": " + Stamp(finding.worst) + ", \"start\": " + Stamp(finding.start) +
        ", \"size\": " + JsonNumber(finding.size) + ", \"limit\": " + JsonNumber(finding.limit) +
        ", \"unit\": " + JsonString(finding.unit) + ", \"what\": " + JsonString(finding.what) +
        ", \"remedy\": " + JsonString(finding.remedy) + "}";
  }
  return json + (findings.empty() ? "]" : "\n  ]");
}

std::string JsonClamps(const ClampJudge::Range& clamps) {
  const auto number = [&](double value) {
    return clamps.known ? JsonNumber(value) : std::string("null");
  };
  return ", \"clamps_first\": " + number(clamps.first) +
         ", \"clamps_min\": " + number(clamps.least) + ", \"clamps_max\": " + number(clamps.most) +
         ", \"clamps_max_at\": " + Stamp(clamps.most_at) +
         ", \"clamps_turn\": " + number(clamps.turn) +
         ", \"clamps_turn_at\": " + Stamp(clamps.turn_at);
}

}  // namespace cosserat_cable
