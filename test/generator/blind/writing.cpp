// folder/set, folder/unseen and folder/truth.json of a blind set.

#include <sstream>

#include "blind_set.h"

namespace cosserat_cable::generator {
namespace {

std::string listJson(const std::vector<std::string>& names) {
  std::string text = "[";
  for (size_t i = 0; i < names.size(); ++i) text += (i > 0 ? ", \"" : "\"") + names[i] + "\"";
  return text + "]";
}

std::string sigmaJson(const MeasurementSet& set) {
  std::string text = "{";
  for (size_t i = 0; i < set.experiments.size(); ++i) {
    const MeasuredExperiment& e = set.experiments[i];
    text += std::string(i > 0 ? "," : "") + "\n    \"" + e.experiment.name + "\": {";
    for (size_t c = 0; c < e.experiment.channels.size(); ++c) {
      text += std::string(c > 0 ? ", " : "") + "\"" + e.experiment.channels[c].column +
              "\": " + number(e.sigma[c]);
    }
    text += "}";
  }
  return text + "\n  }";
}

std::string truthJson(const BlindSet& set) {
  const CableData& cable = set.seen.truth;
  std::ostringstream out;
  out << "{\n  \"format\": 1,\n  \"suite\": \"" << set.plan.suite << "\",\n  \"label\": \""
      << set.label << "\",\n  \"seed\": " << set.plan.seed
      << ",\n  \"snr_db\": " << number(set.plan.snr)
      << ",\n  \"strength\": {\"asked\": " << number(set.plan.strength)
      << ", \"reached\": " << number(set.reached) << ", \"experiments\": {";
  for (size_t i = 0; i < set.strengths.size(); ++i) {
    out << (i > 0 ? ", " : "") << "\"" << set.seen.experiments[i].experiment.name
        << "\": " << number(set.strengths[i]);
  }
  const Expectation& e = set.expected;
  out << "}},\n  \"separation\": " << number(set.separation)
      << ",\n  \"expected\": {\"verdict\": \"" << e.verdict
      << "\", \"causes\": " << listJson(e.causes) << ", \"also\": " << listJson(e.also)
      << ",\n    \"tolerated\": " << listJson(e.tolerated)
      << ", \"undetermined\": " << listJson(e.undetermined)
      << "},\n  \"parameters\": {\"EI\": " << number(cable.EI)
      << ", \"eta_EI\": " << number(cable.eta_EI) << ", \"GJ\": " << number(cable.GJ)
      << ", \"eta_GJ\": " << number(cable.eta_GJ) << "},\n"
      << effectsJson(set.seen.effects)
      << "  \"noise\": {\"told\": " << (set.told ? "true" : "false")
      << ", \"correlation\": " << number(set.correlation)
      << "},\n  \"sigma\": " << sigmaJson(set.seen)
      << ",\n  \"unseen_sigma\": " << sigmaJson(set.unseen) << "\n}\n";
  return out.str();
}

}  // namespace

void writeBlind(const BlindSet& set, const std::string& folder) {
  writeMeasurement(set.seen, folder + "/set");
  writeMeasurement(set.unseen, folder + "/unseen");
  writeFile(folder + "/truth.json", truthJson(set));
}

}  // namespace cosserat_cable::generator
