#include "verdict_json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/fit/information.h"
#include "cosserat_cable/identification/identified_cable.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/record_csv.h"

namespace cosserat_cable {
namespace {

using nlohmann::json;

std::string Joined(const std::vector<std::string>& causes) {
  std::string text;
  for (const std::string& cause : causes) text += (text.empty() ? "" : "+") + cause;
  return text;
}

json ParametersJson(const std::map<std::string, FoundParameter>& found) {
  json values = json::object();
  for (const auto& [name, one] : found)
    values[name] = one.reason.empty() ? json::array({one.value, one.sd}) : json();
  return values;
}

void AddUnits(const std::map<std::string, FoundParameter>& found, json* units) {
  for (const auto& [name, one] : found) (*units)[name] = one.unit;
}

json ReasonsJson(const std::map<std::string, FoundParameter>& found) {
  json reasons = json::object();
  for (const auto& [name, one] : found)
    if (!one.reason.empty()) reasons[name] = one.reason;
  return reasons;
}

bool HasFaults(const Diagnosis& diagnosis) {
  return std::any_of(diagnosis.extended.begin(), diagnosis.extended.end(),
                     [](const auto& entry) { return IsFault(entry.first); });
}

json CandidateJson(const Candidate& candidate) {
  json entry = {{"cause", Joined(candidate.causes)},
                {"causes", candidate.causes},
                {"fitted", candidate.fitted},
                {"promise", candidate.promise},
                {"rejected", candidate.rejected.empty() ? json() : json(candidate.rejected)}};
  entry["share"] = candidate.fitted ? json(candidate.share) : json();
  entry["gain"] = candidate.fitted ? json(candidate.gain) : json();
  entry["cost"] = candidate.fitted ? json::array({candidate.chi2, candidate.samples}) : json();
  entry["worse"] = candidate.fitted ? json::array({candidate.worse, candidate.worse_se}) : json();
  entry["heldout"] =
      candidate.fitted ? json::array({candidate.heldout, candidate.heldout_se}) : json();
  if (candidate.fitted) {
    entry["log_likelihood"] = candidate.log_likelihood;
    entry["adequate"] = candidate.adequate;
    entry["parameters"] = ParametersJson(candidate.found);
    entry["undetermined"] = ReasonsJson(candidate.found);
  }
  return entry;
}

}  // namespace

json VerdictJson(const MeasurementSet& set, const Diagnosis& diagnosis) {
  json verdict = {{"format", 1},
                  {"set", std::filesystem::absolute(set.folder).string()},
                  {"verdict", ToString(diagnosis.verdict)},
                  {"causes", diagnosis.causes},
                  {"sentence", diagnosis.sentence},
                  {"interrupted", diagnosis.interrupted},
                  {"noise_floor", diagnosis.noise_floor},
                  {"noise_known", diagnosis.noise_known},
                  {"seconds", diagnosis.seconds},
                  {"warnings", diagnosis.warnings}};
  verdict["units"] = json::object();
  AddUnits(diagnosis.baseline, &verdict["units"]);
  for (const Candidate& candidate : diagnosis.candidates)
    AddUnits(candidate.found, &verdict["units"]);
  verdict["baseline"] = {{"cable", kBaselineCable},
                         {"parameters", ParametersJson(diagnosis.baseline)},
                         {"undetermined", ReasonsJson(diagnosis.baseline)},
                         {"times_noise", diagnosis.baseline_times_noise},
                         {"log_likelihood", diagnosis.baseline_log_likelihood},
                         {"freedom", diagnosis.baseline_freedom},
                         {"rms_test", diagnosis.rms_baseline}};
  verdict["extended"] = json();
  if (diagnosis.has_extended) {
    verdict["extended"] = {
        {"cable", kExtendedCable},
        {"causes", diagnosis.extended_causes},
        {"parameters", ParametersJson(diagnosis.extended)},
        {"undetermined", ReasonsJson(diagnosis.extended)},
        {"times_noise", diagnosis.extended_times_noise},
        {"rms_test", diagnosis.gain ? json(diagnosis.gain->rms_extended) : json()}};
    if (HasFaults(diagnosis)) verdict["extended"]["measurement"] = kExtendedMeasurement;
  }
  verdict["gain"] = diagnosis.gain ? json({{"value", diagnosis.gain->value},
                                           {"low", diagnosis.gain->low},
                                           {"high", diagnosis.gain->high}})
                                   : json();
  verdict["candidates"] = json::array();
  for (const Candidate& candidate : diagnosis.candidates)
    verdict["candidates"].push_back(CandidateJson(candidate));
  verdict["next_experiment"] =
      diagnosis.next_experiment.empty() ? json() : json(diagnosis.next_experiment);
  verdict["records"] = json::array();
  for (const RecordView& view : diagnosis.records) {
    json noise = json::object();
    for (std::size_t c = 0; c < view.columns.size(); ++c)
      noise[view.columns[c]] = view.noise[static_cast<Eigen::Index>(c)];
    verdict["records"].push_back({{"experiment", view.experiment},
                                  {"file", "fit/" + view.experiment + ".csv"},
                                  {"noise", noise}});
  }
  verdict["stages"] = json::array();
  for (const DiagnosisStage& stage : diagnosis.stages)
    verdict["stages"].push_back({{"stage", stage.name},
                                 {"seconds", stage.seconds},
                                 {"simulations", stage.count.simulations},
                                 {"steps", stage.count.steps}});
  return verdict;
}

std::string FoundCableText(const MeasurementSet& set, const CableKeys& cable,
                           const std::map<std::string, FoundParameter>& all) {
  Estimation estimation;
  estimation.cable = cable;
  estimation.cable.faults = {};
  for (const auto& [name, found] : all) {
    if (IsFault(name)) continue;
    ParameterEstimate one;
    one.unknown.name = name;
    one.unknown.unit = found.unit;
    one.determined = found.reason.empty();
    one.reason = found.reason;
    one.value = found.value;
    one.sd = found.sd;
    one.low = found.value - kNormal95 * found.sd;
    one.high = found.value + kNormal95 * found.sd;
    estimation.parameters.push_back(one);
  }
  return IdentifiedCableText(set, estimation);
}

std::string FitCsv(const Experiment& experiment, const RecordView& view) {
  std::vector<std::string> columns;
  const bool extended = view.extended.size() > 0;
  const Eigen::Index each = extended ? 3 : 2;
  Eigen::MatrixXd values(view.measured.rows(), each * view.measured.cols());
  for (Eigen::Index c = 0; c < view.measured.cols(); ++c) {
    const std::string& column = view.columns[static_cast<std::size_t>(c)];
    columns.push_back(column);
    values.col(each * c) = view.measured.col(c);
    columns.push_back(column + ".plain");
    values.col(each * c + 1) = view.baseline.col(c);
    if (!extended) continue;
    columns.push_back(column + ".extended");
    values.col(each * c + 2) = view.extended.col(c);
  }
  return RecordCsv(experiment.record, columns, values);
}

std::string VerdictTable(const Diagnosis& diagnosis) {
  std::ostringstream out;
  out << "verdict: " << ToString(diagnosis.verdict);
  for (const std::string& cause : diagnosis.causes)
    out << (cause == diagnosis.causes.front() ? ": " : ", ") << cause;
  out << "\n" << diagnosis.sentence << "\n";
  if (diagnosis.gain)
    out << "Of what the plain model gets wrong in records that no fit saw, "
        << FormatRounded(100 * diagnosis.gain->value, 3) << " % is gone (95 % from "
        << FormatRounded(100 * diagnosis.gain->low, 3) << " to "
        << FormatRounded(100 * diagnosis.gain->high, 3) << " %).\n";
  if (diagnosis.has_extended)
    out << "With " << Joined(diagnosis.extended_causes)
        << (diagnosis.verdict == Verdict::kAmbiguous ? ", which fits best" : "")
        << " (95 % intervals):\n";
  for (const auto& [name, found] : diagnosis.extended) {
    out << "  " << name << ": ";
    if (found.reason.empty())
      out << FormatRounded(found.value, DigitsFor(found.value, found.sd)) << " +- "
          << FormatRounded(kNormal95 * found.sd, 2) << (found.unit.empty() ? "" : " " + found.unit)
          << "\n";
    else
      out << "undetermined: " << found.reason << "\n";
  }
  out << "\ncandidate                            explains  times noise  why not\n";
  for (const Candidate& candidate : diagnosis.candidates) {
    if (!candidate.fitted) continue;
    char line[160];
    std::snprintf(line, sizeof line, "%-36s %6.1f %%  %11s  ", Joined(candidate.causes).c_str(),
                  100 * candidate.share,
                  FormatRounded(std::sqrt(candidate.chi2 / candidate.samples), 3).c_str());
    out << line << candidate.rejected << "\n";
  }
  if (!diagnosis.next_experiment.empty()) out << "Next: " << diagnosis.next_experiment << "\n";
  return out.str();
}

}  // namespace cosserat_cable
