#include "trial.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

using Role = HypothesisNumber::Role;

// Of more markers, none is taken to be another sensor than the others.
constexpr std::size_t kMostPlaces = 6;

/// Items of a list that the set has already stay; the hypothesis is the next one.
std::string NextItem(const std::string& path, const CableKeys& keys) {
  const std::size_t bracket = path.find("[0].");
  if (bracket == std::string::npos || path.find("tilt[") == bracket - 4) return path;
  for (int item = 0;; ++item) {
    const std::string begin = path.substr(0, bracket) + "[" + std::to_string(item) + "].";
    const std::vector<std::string> known = ParameterPaths(keys);
    const bool taken = std::any_of(known.begin(), known.end(), [&](const std::string& one) {
      return one.rfind(begin, 0) == 0;
    });
    bool given = taken;
    if (path.rfind("faults.sensor", 0) == 0)
      given = keys.faults.value && static_cast<int>(keys.faults.value->sensor.size()) > item;
    if (!given) return begin + path.substr(bracket + 4);
  }
}

double NeutralOf(const std::string& path) {
  const std::optional<Parameter> parameter = FindParameter(path);
  const double neutral = parameter && parameter->neutral ? *parameter->neutral : 0;
  return std::isfinite(neutral) ? neutral : 0;
}

/// Whether it is neither a factor nor an angle.
bool HasDimension(const std::string& path) {
  const std::optional<Parameter> parameter = FindParameter(path);
  return parameter && !parameter->unit.empty() && parameter->unit != "rad";
}

bool CanBeNegative(const std::string& path) {
  const std::optional<Parameter> parameter = FindParameter(path);
  if (!parameter) return false;
  return parameter->sign == ParameterSign::kSigned || NeutralOf(path) > parameter->lower;
}

/// Channels that one sensor may measure: those of a quantity, and those of one at a place; not all.
std::vector<std::vector<std::string>> SensorGroups(const MeasurementSet& set) {
  std::set<std::string> all;
  std::map<std::string, std::set<std::string>> of_quantity, of_place;
  for (const Experiment& experiment : set.experiments)
    for (const Channel& channel : experiment.channels) {
      const std::string quantity = ToString(channel.quantity);
      all.insert(channel.column);
      of_quantity[quantity].insert(channel.column);
      of_place[quantity + " " + FormatNumber(channel.s)].insert(channel.column);
    }
  std::set<std::set<std::string>> groups;
  for (const auto& [quantity, columns] : of_quantity) groups.insert(columns);
  if (of_place.size() <= kMostPlaces)
    for (const auto& [place, columns] : of_place) groups.insert(columns);
  groups.erase(all);
  std::vector<std::vector<std::string>> result;
  for (const std::set<std::string>& group : groups) result.emplace_back(group.begin(), group.end());
  return result;
}

Trial MakeTrial(const std::string& cause, const Hypothesis& hypothesis,
                const MotionScales& scales) {
  Trial trial;
  trial.cause = cause;
  for (const std::vector<HypothesisNumber>& numbers : hypothesis.components) {
    TrialComponent component;
    component.one_sided = true;
    for (HypothesisNumber number : numbers) {
      number.times *= scales.Of(number.scale, number.path);
      number.path = NextItem(number.path, scales.keys);
      if (number.role == Role::kSize && CanBeNegative(number.path)) component.one_sided = false;
      component.numbers.push_back(number);
    }
    trial.components.push_back(component);
  }
  return trial;
}

}  // namespace

bool TrialComponent::grows() const {
  return std::any_of(numbers.begin(), numbers.end(), [](const HypothesisNumber& number) {
    return number.role == Role::kSize || number.role == Role::kInverse;
  });
}

bool TrialComponent::acts_beside() const {
  return std::any_of(numbers.begin(), numbers.end(),
                     [](const HypothesisNumber& number) { return number.role == Role::kBeside; });
}

std::vector<std::pair<std::string, double>> TrialComponent::At(double part) const {
  std::vector<std::pair<std::string, double>> values;
  for (const HypothesisNumber& number : numbers) {
    double value = number.times;
    if (number.role == Role::kSize)
      value = NeutralOf(number.path) + number.origin + part * size * number.times;
    if (number.role == Role::kInverse) value = number.times / (part * size);
    if (const std::optional<Parameter> parameter = FindParameter(number.path))
      value = std::clamp(value, parameter->lower, parameter->upper);
    values.push_back({number.path, value});
  }
  return values;
}

std::vector<std::string> Trial::FreePaths() const {
  std::vector<std::string> paths;
  for (const TrialComponent& component : components)
    for (const HypothesisNumber& number : component.numbers)
      if (number.role != Role::kHeld &&
          std::find(paths.begin(), paths.end(), number.path) == paths.end())
        paths.push_back(number.path);
  return paths;
}

bool Trial::CanBeBeside(const Trial& other) const {
  if (other.cause != cause) return true;
  if (other.channels != channels) return false;
  const std::map<std::string, double> own = Values();
  for (const auto& [path, value] : other.Values())
    if (own.count(path) > 0) return false;
  return true;
}

std::map<std::string, double> Trial::Values() const {
  std::map<std::string, double> values;
  for (const TrialComponent& component : components)
    for (const auto& [path, value] : component.At()) values[path] = value;
  return values;
}

bool Trial::IsFaint(const std::function<double(const std::string& path)>& value_of) const {
  const double least = FindCause(cause)->least;
  for (const TrialComponent& component : components)
    for (const HypothesisNumber& number : component.numbers)
      if (number.role != Role::kSize || HasDimension(number.path) ||
          std::abs(value_of(number.path) - NeutralOf(number.path)) >= least)
        return false;
  return true;
}

std::vector<std::string> CausesOf(const std::vector<Trial>& trials) {
  std::vector<std::string> names;
  for (const Trial& trial : trials) names.push_back(trial.cause);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<Trial> TrialsFromSimpler(const Cause& cause, const MotionScales& scales) {
  std::vector<Trial> trials;
  for (const Hypothesis& hypothesis : cause.from_simpler) {
    Trial trial = MakeTrial(cause.name, hypothesis, scales);
    auto& components = trial.components;
    components.erase(
        std::remove_if(components.begin(), components.end(),
                       [](const TrialComponent& component) {
                         return std::any_of(
                             component.numbers.begin(), component.numbers.end(),
                             [](const HypothesisNumber& number) { return !(number.times > 0); });
                       }),
        components.end());
    if (!components.empty()) trials.push_back(trial);
  }
  return trials;
}

std::vector<Trial> AllTrials(const MeasurementSet& set, const MotionScales& scales) {
  std::vector<Trial> trials;
  for (const Cause& cause : Causes())
    for (const Hypothesis& hypothesis : cause.hypotheses) {
      Trial trial = MakeTrial(cause.name, hypothesis, scales);
      const std::vector<std::string> paths = trial.FreePaths();
      if (std::any_of(paths.begin(), paths.end(),
                      [&](const std::string& path) { return GivesParameter(path, set.cable); }))
        continue;
      trials.push_back(trial);
      if (trial.cause != "sensor") continue;
      for (const std::vector<std::string>& group : SensorGroups(set)) {
        trial.channels = group;
        trials.push_back(trial);
      }
    }
  return trials;
}

MeasurementSet WithTrials(const MeasurementSet& set, const std::vector<Trial>& trials) {
  MeasurementSet extended = set;
  std::vector<UncertainKey> uncertain;
  if (set.cable.uncertain.value) {
    uncertain = *set.cable.uncertain.value;
  } else {
    for (const char* name : {"EI", "GJ", "eta_EI", "eta_GJ"}) uncertain.push_back({name, {}});
  }
  for (const Trial& trial : trials) {
    for (const auto& [path, value] : trial.Values()) SetParameter(path, value, &extended.cable);
    if (!trial.channels.empty())
      extended.cable.faults.value->sensor.back().channels = trial.channels;
    for (const std::string& path : trial.FreePaths()) uncertain.push_back({path, {}});
  }
  extended.cable.uncertain.value = uncertain;
  return extended;
}

}  // namespace cosserat_cable
