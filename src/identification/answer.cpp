#include "answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <sstream>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/identification/identified_cable.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/record_csv.h"

namespace cosserat_cable {
namespace {

using nlohmann::json;

const char* ChannelUnit(Quantity quantity) {
  switch (quantity) {
    case Quantity::kPosition:
      return "m";
    case Quantity::kVelocity:
      return "m/s";
    case Quantity::kAcceleration:
      return "m/s^2";
    case Quantity::kAngle:
      return "rad";
    case Quantity::kRate:
      return "rad/s";
    case Quantity::kForce:
      return "N";
    case Quantity::kMoment:
      return "N m";
  }
  return "";
}

bool OfCable(const ParameterEstimate& estimate) {
  return estimate.unknown.kind == Unknown::Kind::kCable;
}

const char* NoiseFrom(NoiseLevel::Source source) {
  switch (source) {
    case NoiseLevel::Source::kGiven:
      return "set";
    case NoiseLevel::Source::kRecord:
      return "record";
    case NoiseLevel::Source::kRepeats:
      return "repeats";
    case NoiseLevel::Source::kUnknown:
      return "residual";
  }
  return "";
}

/// The noise's own level where there is one, else what the fit leaves.
double NoiseOf(const ChannelFit& fit) {
  return fit.noise.source == NoiseLevel::Source::kUnknown ? fit.rms : fit.noise.sd;
}

json Finite(double value) { return std::isfinite(value) ? json(value) : json(); }

/// `interval`: between two samples, on average [s]; 0 of a quasi-static record.
json ChannelJson(const Channel& channel, const ChannelFit& fit, double interval) {
  return {{"column", channel.column},
          {"quantity", ToString(channel.quantity)},
          {"unit", ChannelUnit(channel.quantity)},
          {"sigma", NoiseOf(fit)},
          {"sigma_given", fit.sigma_given},
          {"noise_from", NoiseFrom(fit.noise.source)},
          {"weighted_by", fit.sigma},
          {"rms", fit.rms},
          {"references",
           {{"constant", Finite(fit.reference.constant)},
            {"filter", Finite(fit.reference.filter)},
            {"filter_unseen", Finite(fit.reference.filter_unseen)}}},
          {"correlation_samples", fit.correlation_samples},
          {"correlation_time", interval > 0 ? json(interval * fit.correlation_samples) : json()},
          {"misfit", fit.times_noise > 0 ? json(fit.times_noise) : json()},
          {"explained", fit.times_noise > 0 ? json(!fit.misfit) : json()}};
}

/// Root mean square over all channels of a quantity; NaN where one of them has none.
struct Together {
  double squares = 0;
  int count = 0;

  void Add(double rms) {
    squares += rms * rms;
    ++count;
  }
  double rms() const { return std::sqrt(squares / std::max(count, 1)); }
};

/// The model beside models without mechanics, a line per quantity whose channels follow a clamp.
std::string AgainstReferences(const MeasurementSet& set, const Estimation& estimation) {
  std::map<Quantity, std::array<Together, 4>> by_quantity;
  for (std::size_t e = 0; e < set.experiments.size(); ++e)
    for (std::size_t c = 0; c < set.experiments[e].channels.size(); ++c) {
      const ChannelFit& fit = estimation.experiments[e].channels[c];
      if (!std::isfinite(fit.reference.filter)) continue;
      auto& of = by_quantity[set.experiments[e].channels[c].quantity];
      of[0].Add(fit.rms);
      of[1].Add(fit.reference.constant);
      of[2].Add(fit.reference.filter);
      of[3].Add(fit.reference.filter_unseen);
    }
  std::ostringstream out;
  for (const auto& [quantity, of] : by_quantity) {
    const auto text = [&, unit = ChannelUnit(quantity)](const Together& one) {
      return FormatRounded(one.rms(), 3) + " " + unit;
    };
    out << ToString(quantity) << ": the model leaves " << text(of[0])
        << " (root mean square), the mean of each record " << text(of[1])
        << ", a linear filter of the clamps' motion " << text(of[2]);
    if (std::isfinite(of[3].rms())) out << ", and " << text(of[3]) << " of a record left out";
    out << ".\n";
  }
  return out.str();
}

json SlipJson(const ChannelSlip& slip) {
  json entry = {{"experiment", slip.experiment},
                {"column", slip.column.empty() ? json() : json(slip.column)},
                {"kind", slip.kind},
                {"text", slip.text},
                {"factor", slip.factor},
                {"constant", slip.constant},
                {"delay", slip.delay},
                {"misfit", slip.before},
                {"misfit_with", slip.after}};
  if (!slip.shows.empty()) entry["shows"] = slip.shows;
  return entry;
}

}  // namespace

json AnswerJson(const MeasurementSet& set, const Estimation& estimation) {
  json answer = {{"format", 1}, {"set", set.folder}, {"converged", estimation.converged}};
  answer["parameters"] = json::object();
  answer["undetermined"] = json::object();
  answer["untrusted"] = json::object();
  answer["nuisances"] = json::object();
  json names = json::array();
  std::vector<int> shown;
  for (std::size_t i = 0; i < estimation.parameters.size(); ++i) {
    const ParameterEstimate& one = estimation.parameters[i];
    const std::string& name = one.unknown.name;
    const json value = one.determined ? json::array({one.value, one.sd}) : json();
    if (one.determined) {
      names.push_back(name);
      shown.push_back(static_cast<int>(i));
    }
    if (!OfCable(one)) {
      answer["nuisances"][name] = value;
      continue;
    }
    answer["parameters"][name] = value;
    answer["units"][name] = one.unknown.unit;
    if (one.unknown.start_known) answer["start"][name] = one.unknown.start;
    if (!one.doubt.empty()) answer["untrusted"][name] = one.doubt;
    if (one.determined) {
      answer["intervals"][name] = {one.low, one.high};
      answer["intervals_of_curvature"][name] = {one.value - one.quantile * one.sd,
                                                one.value + one.quantile * one.sd};
      if (!one.profile.value.empty())
        answer["profiles"][name] = {{"value", one.profile.value},
                                    {"deviance", one.profile.deviance}};
    } else {
      answer["undetermined"][name] = one.reason;
      if (one.unknown.start_known) answer["defaults_kept"][name] = one.value;
    }
  }
  json matrix = json::array();
  for (const int i : shown) {
    json row = json::array();
    for (const int k : shown) row.push_back(estimation.correlation(i, k));
    matrix.push_back(row);
  }
  answer["correlation"] = {{"names", names}, {"matrix", matrix}};
  answer["combinations"] = json::array();
  for (const Combination& sum : estimation.combinations)
    answer["combinations"].push_back(
        {{"text", sum.text}, {"value", sum.value}, {"sd", sum.sd}, {"unit", sum.unit}});
  answer["scatter"] = json::object();
  for (const ParameterScatter& one : estimation.scatter)
    answer["scatter"][one.name] = {
        {"sd", one.sd}, {"records", one.records}, {"freedom", one.freedom}};
  answer["noise"] = json::object();
  answer["experiments"] = json::array();
  for (std::size_t e = 0; e < set.experiments.size(); ++e) {
    const Experiment& experiment = set.experiments[e];
    json entry = {{"name", experiment.name},
                  {"kind", experiment.kind},
                  {"quasi_static", experiment.quasi_static()},
                  {"length", SpecimenKeys(set, experiment).length.value.value_or(0.0)},
                  {"file", "fit/" + experiment.name + ".csv"},
                  {"channels", json::array()}};
    for (std::size_t c = 0; c < experiment.channels.size(); ++c) {
      const ChannelFit& fit = estimation.experiments[e].channels[c];
      const std::vector<double>& t = experiment.record.t;
      const double interval = experiment.quasi_static() || t.size() < 2
                                  ? 0.0
                                  : (t.back() - t.front()) / static_cast<double>(t.size() - 1);
      json channel = ChannelJson(experiment.channels[c], fit, interval);
      const std::string name = experiment.name + "/" + experiment.channels[c].column;
      for (const ParameterEstimate& one : estimation.parameters)
        if (one.unknown.name == name + ".offset") channel["offset"] = one.value;
      entry["channels"].push_back(channel);
      answer["noise"][name] = NoiseOf(fit);
    }
    answer["experiments"].push_back(entry);
  }
  answer["slips"] = json::array();
  for (const ChannelSlip& slip : estimation.slips) answer["slips"].push_back(SlipJson(slip));
  answer["discretisation"] = estimation.discretisation;
  TellTimes(estimation.seconds, estimation.stages, &answer);
  answer["warnings"] = estimation.warnings;
  return answer;
}

void TellTimes(double seconds, const std::vector<StageCost>& stages, json* answer) {
  (*answer)["seconds"] = seconds;
  json& list = (*answer)["stages"] = json::array();
  for (const StageCost& stage : stages)
    list.push_back({{"stage", stage.name},
                    {"seconds", stage.seconds},
                    {"simulations", stage.count.simulations},
                    {"steps", stage.count.steps},
                    {"element_steps", stage.count.element_steps}});
}

std::string FitCsv(const Experiment& experiment, const ExperimentFit& fit) {
  std::vector<std::string> columns;
  Eigen::MatrixXd values(fit.simulated.rows(), 2 * fit.simulated.cols());
  for (Eigen::Index c = 0; c < fit.simulated.cols(); ++c) {
    const std::string& column = experiment.channels[static_cast<std::size_t>(c)].column;
    columns.push_back(column);
    columns.push_back(column + ".fit");
    values.col(2 * c) = experiment.record.values.col(c);
    values.col(2 * c + 1) = fit.simulated.col(c);
  }
  return RecordCsv(experiment.record, columns, values);
}

std::string AnswerTable(const MeasurementSet& set, const Estimation& estimation) {
  std::ostringstream out;
  char line[320];
  std::size_t longest = 22;
  for (const ParameterEstimate& one : estimation.parameters)
    if (OfCable(one)) longest = std::max(longest, one.unknown.name.size());
  const int width = static_cast<int>(longest);
  std::snprintf(line, sizeof line, "%-*s %13s %13s %13s  %-9s\n", width, "parameter", "value",
                "95 % from", "to", "unit");
  out << line;
  for (const ParameterEstimate& one : estimation.parameters) {
    if (!OfCable(one)) continue;
    const int digits = DigitsFor(one.value, one.sd);
    if (one.determined)
      std::snprintf(line, sizeof line, "%-*s %13s %13s %13s  %-9s%s\n", width,
                    one.unknown.name.c_str(), FormatRounded(one.value, digits).c_str(),
                    FormatRounded(one.low, digits).c_str(), FormatRounded(one.high, digits).c_str(),
                    one.unknown.unit.c_str(),
                    one.doubt.empty() ? "" : "  not to be trusted: see the warnings");
    else
      std::snprintf(line, sizeof line, "%-*s %13s  %s\n", width, one.unknown.name.c_str(),
                    "undetermined", one.reason.substr(0, 200).c_str());
    out << line;
  }
  out << AgainstReferences(set, estimation);
  for (const ChannelSlip& slip : estimation.slips)
    out << slip.experiment << ": " << slip.text << (slip.text.back() == '?' ? "" : ".")
        << " It would leave " << FormatRounded(slip.after, 2) << " times the noise instead of "
        << FormatRounded(slip.before, 2) << ".\n";
  return out.str();
}

}  // namespace cosserat_cable
