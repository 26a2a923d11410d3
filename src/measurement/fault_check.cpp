#include "cosserat_cable/measurement/fault_check.h"

#include <algorithm>
#include <set>

#include "cosserat_cable/cable/parameters.h"
#include "fault_reader.h"

namespace cosserat_cable {
namespace {

const char* const kQuasiStatic =
    "got this of a quasi-static record (its first column is `step`), which has no time";

bool HasAxis(const Channel& channel) {
  return channel.quantity != Quantity::kAngle && channel.quantity != Quantity::kRate;
}

bool Begins(const std::string& path, const std::string& with) { return path.rfind(with, 0) == 0; }

// What is wrong with faults in one experiment.
class FaultCheck {
 public:
  FaultCheck(const Experiment& experiment, Problems* problems)
      : experiment_(experiment), problems_(problems) {}

  void Run(const Faults& faults) {
    if (faults.clock && experiment_.quasi_static())
      problems_->Add(faults.clock->mark, kQuasiStatic);
    for (const SensorFault& sensor : faults.sensor) CheckSensor(sensor);
    if (faults.a) CheckClamp(*faults.a, experiment_.a);
    if (faults.b) CheckClamp(*faults.b, experiment_.b);
  }

 private:
  void CheckSensor(const SensorFault& sensor) {
    std::vector<std::string> columns;
    bool axes = false;
    for (const Channel& channel : experiment_.channels) {
      columns.push_back(channel.column);
      const bool in_group =
          sensor.channels.empty() ||
          std::count(sensor.channels.begin(), sensor.channels.end(), channel.column) > 0;
      axes = axes || (in_group && HasAxis(channel));
    }
    bool known = true;
    for (std::size_t i = 0; i < sensor.channel_marks.size(); ++i) {
      const std::string& name = sensor.channels[i];
      if (std::count(columns.begin(), columns.end(), name) > 0) continue;
      known = false;
      const std::string nearest = NearestWord(name, columns);
      problems_->Add(sensor.channel_marks[i],
                     "got '" + name + "', expected the column of a channel" +
                         (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
    }
    if (const auto tilt = sensor.marks.find("tilt"); tilt != sensor.marks.end() && known && !axes)
      problems_->Add(tilt->second,
                     "got a tilt of channels without position axes (angle, rate), expected one of "
                     "channels with an `axis`");
    if (const auto filter = sensor.marks.find("low_pass");
        filter != sensor.marks.end() && experiment_.quasi_static())
      problems_->Add(filter->second, kQuasiStatic);
  }

  void CheckClamp(const ClampMotionFault& fault, const EndCondition& end) {
    if (end.kind != EndCondition::Kind::kClamp) {
      problems_->Add(fault.mark,
                     "got the motion of an end that no clamp holds, expected {pose: [...]} or "
                     "{motion: FILE} there");
      return;
    }
    for (const char* key : {"amplitude", "phase", "bracket"}) {
      const auto found = fault.marks.find(key);
      if (found == fault.marks.end()) continue;
      if (!end.motion)
        problems_->Add(found->second,
                       "got this of a clamp that stands still, expected a `motion` of that end: a "
                       "fixed `pose` can be tilted only");
      else if (experiment_.quasi_static() && std::string(key) != "amplitude")
        problems_->Add(found->second, kQuasiStatic);
    }
  }

  const Experiment& experiment_;
  Problems* problems_;
};

// What no experiment that goes by the set's faults can have: said as of the first of them.
void CheckSetsOwn(const MeasurementSet& set, Problems* problems) {
  if (!set.cable.faults.value) return;
  std::optional<Problems> first;
  std::set<std::string> everywhere;
  for (const Experiment& experiment : set.experiments) {
    if (experiment.specimen.faults.given()) continue;
    Problems found;
    FaultCheck(experiment, &found).Run(*set.cable.faults.value);
    std::set<std::string> keys, common;
    for (const Problem& problem : found.all()) keys.insert(problem.key);
    for (const std::string& key : everywhere)
      if (keys.count(key)) common.insert(key);
    everywhere = first ? common : keys;
    if (!first) first = found;
  }
  if (!first) return;
  for (const Problem& problem : first->all())
    if (everywhere.count(problem.key))
      problems->Add(problem.file, problem.line, problem.key, problem.message);
}

void CheckUncertain(const MeasurementSet& set, Problems* problems) {
  if (!set.cable.uncertain.value) return;
  for (const UncertainKey& key : *set.cable.uncertain.value) {
    if (!Begins(key.name, "faults.")) continue;
    const std::optional<Parameter> parameter = FindParameter(key.name);
    // A fault that stands nowhere can be named where it has no effect at some value.
    bool exists = GivesParameter(key.name, set.cable) ||
                  (parameter && parameter->neutral && CanMakeFault(key.name, set.cable));
    bool shows = false;
    for (const Experiment& experiment : set.experiments) {
      exists = exists || GivesParameter(key.name, experiment.specimen);
      shows = shows || CanHaveFault(key.name, experiment);
    }
    if (!parameter || !exists) {
      const std::string nearest = NearestWord(key.name, FaultPaths(set.cable));
      problems->Add(key.mark, "got '" + key.name + "', expected a number of `faults`" +
                                  (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
    } else if (!shows) {
      problems->Add(key.mark, "got '" + key.name +
                                  "', which no experiment of the set can show, expected a fault "
                                  "that one of them can have");
    }
  }
}

}  // namespace

bool CanHaveFault(const std::string& path, const Experiment& experiment) {
  const bool moves = !experiment.quasi_static();
  if (Begins(path, "faults.clock.")) return moves;
  if (Begins(path, "faults.sensor[")) {
    if (path.find(".low_pass") != std::string::npos) return moves;
    if (path.find(".tilt[") == std::string::npos) return true;
    return std::any_of(experiment.channels.begin(), experiment.channels.end(), HasAxis);
  }
  const bool at_a = Begins(path, "faults.base_motion.a.");
  if (!at_a && !Begins(path, "faults.base_motion.b.")) return false;
  const EndCondition& end = at_a ? experiment.a : experiment.b;
  if (end.kind != EndCondition::Kind::kClamp) return false;
  if (path.find(".tilt[") != std::string::npos) return true;
  return end.motion && (moves || path.find(".amplitude") != std::string::npos);
}

void CheckFaults(const MeasurementSet& set, Problems* problems) {
  for (const Experiment& experiment : set.experiments)
    if (experiment.specimen.faults.value)
      FaultCheck(experiment, problems).Run(*experiment.specimen.faults.value);
  CheckSetsOwn(set, problems);
  CheckUncertain(set, problems);
}

}  // namespace cosserat_cable
