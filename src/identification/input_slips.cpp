#include "input_slips.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/specimen.h"

namespace cosserat_cable {
namespace {

constexpr double kGravity = 9.80665, kPound = 0.45359237, kOunce = kPound / 16;
// What people leave out or count twice of a force: from a tenth to ten times.
constexpr double kLeastOfLoad = 0.1, kMostOfLoad = 10;
// [s] Nobody looks at a cable that swings for longer.
constexpr double kLongestRecord = 100;
// A rate of sampling that was taken for another one.
constexpr double kLeastOfTimes = 0.3, kMostOfTimes = 3.5;
constexpr double kRadians = 0.017453292519943295;

using Slips = std::vector<InputSlip>;

void Scale(double factor, CableKey<std::vector<LumpedMassKey>>* masses) {
  if (!masses->value) return;
  for (LumpedMassKey& one : *masses->value) one.mass.mass *= factor;
}

void AddLoads(const Experiment& experiment, std::size_t e, Slips* slips) {
  const std::vector<ExperimentLoad::Sample>& forces = experiment.load.samples;
  if (std::none_of(forces.begin(), forces.end(),
                   [](const auto& force) { return force.force_W.norm() > 0; }))
    return;
  const auto scale = [e](double factor, MeasurementSet* changed) {
    for (ExperimentLoad::Sample& force : changed->experiments[e].load.samples)
      force.force_W *= factor;
  };
  for (const auto& [factor, text] :
       {std::pair<double, const char*>{-1, "with the sign of its load turned"},
        {kGravity, "with its load in kilograms"},
        {1e-3 * kGravity, "with its load in grams"},
        {1e-3, "with its load in millinewtons"},
        {kPound * kGravity, "with its load in pounds"},
        {kOunce * kGravity, "with its load in ounces"}})
    slips->push_back({"load", text, factor, "", false, 0, 0, scale});
  // Of several, one alone.
  for (std::size_t k = 0; experiment.load.file.empty() && forces.size() > 1 && k < forces.size();
       ++k)
    slips->push_back(
        {"load", "with the sign of its load at s = " + FormatRounded(forces[k].s) + " m turned", -1,
         "", false, 0, 0, [e, k](double factor, MeasurementSet* changed) {
           changed->experiments[e].load.samples[k].force_W *= factor;
         }});
  slips->push_back({"load", "times its load", 1, "", false, kLeastOfLoad, kMostOfLoad, scale});
}

void AddMasses(const MeasurementSet& set, std::size_t e, Slips* slips) {
  const Experiment& experiment = set.experiments[e];
  const CableKeys keys = SpecimenKeys(set, experiment);
  struct Unit {
    double factor;
    const char* name;
  };
  const std::vector<Unit> units = {{1e-3, "grams"}, {kPound, "pounds"}, {kOunce, "ounces"}};
  const auto in = [](const Unit& unit) {
    return std::string(" in ") + unit.name + " (factor " + FormatRounded(unit.factor) + ")";
  };
  // A record that gives its own may be the only one with another unit.
  const bool own = experiment.specimen.masses.value.has_value();
  if (keys.masses.value && !keys.masses.value->empty())
    for (const Unit& unit : units)
      slips->push_back({"mass", "with `masses`" + in(unit), unit.factor, "", !own, 0, 0,
                        [e, own](double factor, MeasurementSet* changed) {
                          if (own) return Scale(factor, &changed->experiments[e].specimen.masses);
                          Scale(factor, &changed->cable.masses);
                        }});
  for (const std::string& path : ParameterPaths(keys)) {
    if (path.rfind("extensions.added_mass", 0) != 0 || UnitOf(path) != "kg") continue;
    const std::optional<double> value = GetParameter(path, set.cable);
    if (!value || !(*value > 0)) continue;
    for (const Unit& unit : units)
      slips->push_back({"mass", "with [" + path + "]" + in(unit), unit.factor, "", true, 0, 0,
                        [path, value = *value](double factor, MeasurementSet* changed) {
                          SetParameter(path, factor * value, &changed->cable);
                        }});
  }
  if (experiment.b.kind == EndCondition::Kind::kDisc) {
    const auto disc = [&](const std::string& text, double factor, double Disc::*number) {
      slips->push_back({"mass", text + " (factor " + FormatRounded(factor) + ")", factor, "", true,
                        0, 0, [number](double by, MeasurementSet* changed) {
                          for (Experiment& one : changed->experiments) one.b.disc.*number *= by;
                        }});
    };
    if (experiment.b.disc.mass > 0) disc("with the disc's mass in grams", 1e-3, &Disc::mass);
    if (experiment.b.disc.inertia > 0)
      for (const auto& [factor, unit] :
           {std::pair<double, const char*>{1e-3, "g m^2"}, {1e-4, "kg cm^2"}, {1e-7, "g cm^2"}})
        disc(std::string("with the disc's inertia in ") + unit, factor, &Disc::inertia);
  }
  if (keys.mass_per_length.value)
    slips->push_back({"mass", "with [mass_per_length] in g/m (factor 0.001)", 1e-3, "", true, 0, 0,
                      [](double factor, MeasurementSet* changed) {
                        const auto mend = [factor](CableKeys* keys) {
                          if (keys->mass_per_length.value) *keys->mass_per_length.value *= factor;
                        };
                        mend(&changed->cable);
                        for (Experiment& one : changed->experiments) mend(&one.specimen);
                      }});
}

/// Along the other axes of the world, and the other way.
void AddGravities(const Experiment& experiment, std::size_t e, Slips* slips) {
  constexpr double kSame = 1e-6;
  const Eigen::Vector3d& given = experiment.gravity_W;
  const double g = given.norm();
  if (!(g > 0)) return;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const Eigen::Vector3d other = sign * g * Eigen::Vector3d::Unit(axis);
      if ((other - given).norm() < kSame * g) continue;
      slips->push_back({"gravity",
                        std::string("with gravity along ") + (sign < 0 ? "-" : "+") + "xyz"[axis],
                        1, "", false, 0, 0, [e, other](double, MeasurementSet* changed) {
                          changed->experiments[e].gravity_W = other;
                        }});
    }
}

/// Times since the record's first, that another rate of sampling makes.
void AddTimes(const Experiment& experiment, std::size_t e, Slips* slips) {
  if (experiment.quasi_static() || experiment.record.t.empty()) return;
  const auto stretch = [e](double factor, MeasurementSet* changed) {
    std::vector<double>& t = changed->experiments[e].record.t;
    const double first = t.front();
    for (double& one : t) one = first + factor * (one - first);
  };
  const double duration = experiment.record.t.back() - experiment.record.t.front();
  for (const double factor : {1e3, 60.0, 1e-3})
    if (factor * duration < kLongestRecord)
      slips->push_back({"clock", "with times " + FormatRounded(factor, 4) + " times as long",
                        factor, "", false, 0, 0, stretch});
  slips->push_back({"clock", "times its times (another sampling rate?)", 1, "", false,
                    kLeastOfTimes, kMostOfTimes, stretch});
}

}  // namespace

std::vector<InputSlip> InputSlips(const MeasurementSet& set, std::size_t e) {
  Slips slips;
  const Experiment& experiment = set.experiments[e];
  AddLoads(experiment, e, &slips);
  AddMasses(set, e, &slips);
  if (experiment.start.kind == StartCondition::Kind::kTwisted)
    for (const auto& [factor, text] :
         {std::pair<double, const char*>{-1, "with the sign of `twisted` turned"},
          {kRadians, "with `twisted` in degrees"}})
      slips.push_back(
          {"start", text, factor, "", false, 0, 0, [e](double by, MeasurementSet* changed) {
             changed->experiments[e].start.twisted *= by;
           }});
  // What the set says to be known may be off.
  if (set.cable.uncertain.value) {
    const std::string name = experiment.b.kind == EndCondition::Kind::kDisc ? "GJ" : "EI";
    const auto& names = *set.cable.uncertain.value;
    if (std::none_of(names.begin(), names.end(),
                     [&](const UncertainKey& key) { return key.name.rfind(name, 0) == 0; }) &&
        GetParameter(name, SpecimenKeys(set, experiment)))
      slips.push_back(
          {"parameter", "", 1, name, true, 0, 0, [name](double, MeasurementSet* changed) {
             auto& uncertain = changed->cable.uncertain;
             uncertain.value->push_back({name, uncertain.mark});
           }});
  }
  AddGravities(experiment, e, &slips);
  AddMotionSlips(set, e, &slips);
  AddTimes(experiment, e, &slips);
  std::stable_partition(slips.begin(), slips.end(),
                        [](const InputSlip& slip) { return !slip.free_factor(); });
  return slips;
}

}  // namespace cosserat_cable
