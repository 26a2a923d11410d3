#include "cosserat_cable/identification/identified_cable.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

bool OfCable(const ParameterEstimate& estimate) {
  return estimate.unknown.kind == Unknown::Kind::kCable;
}

/// Whether the line of an identified cable with this key has the parameter, and which of the line's
/// numbers it is: "" where it is the only one.
std::optional<std::string> PlaceInLine(const std::string& key, const ParameterEstimate& one) {
  if (!OfCable(one) || key.empty()) return std::nullopt;
  const std::string& name = one.unknown.name;
  if (key == name || key == name + "1" || key == name + "2") return "";
  const std::string law = "extensions." + key;
  if (name.rfind(law + "[", 0) == 0 || name.rfind(law + ".", 0) == 0)
    return name.substr(std::string("extensions.").size());
  return std::nullopt;
}

/// The interval is the one of the table.
std::string Found(const std::string& key, const ParameterEstimate& one) {
  const std::string& name = one.unknown.name;
  const std::string doubt = one.doubt.empty() ? "" : "; not to be trusted: " + one.doubt;
  if (one.determined && key == name + "2")
    return "identified with " + name + "1, in proportion" + doubt;
  if (!one.determined) return "not determined by the data: " + one.reason;
  const int digits = DigitsFor(one.value, one.sd);
  return "identified, 95 % from " + FormatRounded(one.low, digits) + " to " +
         FormatRounded(one.high, digits) + doubt;
}

}  // namespace

/// Digits at which a number's standard deviation shows with two.
int DigitsFor(double value, double sd) {
  constexpr int kFewest = 4, kMost = 12;
  if (!(sd > 0) || value == 0) return kFewest;
  return std::clamp(static_cast<int>(std::ceil(std::log10(std::abs(value) / sd))) + 2, kFewest,
                    kMost);
}

std::string IdentifiedCableText(const MeasurementSet& set, const Estimation& estimation) {
  Problems problems;
  CableFile file;
  file.specimen = true;
  file.cables.push_back(
      CompleteCable(WithoutUnknownDamping(estimation.cable), set.cable_mark, &problems));
  file.marks.emplace_back();
  // Defaults follow from the rest; written out they would no longer.
  const auto is_default = [&](const std::string& key) {
    const std::string base =
        key.back() == '1' || key.back() == '2' ? key.substr(0, key.size() - 1) : key;
    const bool derived = base == "EA" || base == "GA" || base == "eta_EA" || base == "eta_GA";
    return key == "name" || key == "apex" || key == "contact" ||
           (derived && !GivesParameter(base, estimation.cable));
  };
  std::istringstream lines(WriteCableFile(file));
  std::string text, line;
  while (std::getline(lines, line)) {
    const std::size_t begin = line.find_first_not_of(" -"), colon = line.find(':');
    std::string key;
    if (begin != std::string::npos && colon != std::string::npos && colon > begin)
      key = line.substr(begin, colon - begin);
    if (!key.empty() && is_default(key)) continue;
    std::string remark;
    for (const ParameterEstimate& one : estimation.parameters) {
      const std::optional<std::string> of = PlaceInLine(key, one);
      if (of)
        remark +=
            (remark.empty() ? "  # " : "; ") + (of->empty() ? "" : *of + " ") + Found(key, one);
    }
    text += line + remark + "\n";
  }
  return text;
}

}  // namespace cosserat_cable
