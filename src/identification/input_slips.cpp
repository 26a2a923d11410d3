#include "input_slips.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/specimen.h"

namespace cosserat_cable {
namespace {

void Scale(double factor, CableKey<std::vector<LumpedMassKey>>* masses) {
  if (!masses->value) return;
  for (LumpedMassKey& one : *masses->value) one.mass.mass *= factor;
}

}  // namespace

std::vector<InputSlip> InputSlips(const MeasurementSet& set, std::size_t e) {
  constexpr double kGravity = 9.80665, kRadians = 0.017453292519943295;
  std::vector<InputSlip> slips;
  const auto add = [&](const char* kind, const std::string& text, double factor, bool of_set,
                       const auto& change) {
    slips.push_back({kind, text, factor, "", of_set, set});
    change(&slips.back().set);
  };
  const Experiment& experiment = set.experiments[e];
  const std::vector<ExperimentLoad::Sample>& forces = experiment.load.samples;
  if (std::any_of(forces.begin(), forces.end(),
                  [](const auto& force) { return force.force_W.norm() > 0; })) {
    for (const auto& [factor, text] :
         {std::pair<double, const char*>{-1, "with the sign of its load turned"},
          {kGravity, "with its load in kilograms"},
          {1e-3 * kGravity, "with its load in grams"},
          {1e-3, "with its load in millinewtons"},
          {4.4482216, "with its load in pounds"}})
      add("load", text, factor, false, [&, factor = factor](MeasurementSet* changed) {
        for (ExperimentLoad::Sample& force : changed->experiments[e].load.samples)
          force.force_W *= factor;
      });
    // Of several, one alone.
    for (std::size_t k = 0; experiment.load.file.empty() && forces.size() > 1 && k < forces.size();
         ++k)
      add("load", "with the sign of its load at s = " + FormatRounded(forces[k].s) + " m turned",
          -1, false,
          [&](MeasurementSet* changed) { changed->experiments[e].load.samples[k].force_W *= -1; });
  }
  CableKeys keys = SpecimenKeys(set, experiment);
  const auto grams = [](double factor) {
    return " in grams (factor " + FormatRounded(factor) + ")";
  };
  if (keys.masses.value && !keys.masses.value->empty())
    add("mass", "with `masses`" + grams(1e-3), 1e-3, true, [](MeasurementSet* changed) {
      Scale(1e-3, &changed->cable.masses);
      for (Experiment& one : changed->experiments) Scale(1e-3, &one.specimen.masses);
    });
  if (const auto paths = ParameterPaths(keys); true)
    for (const std::string& path : paths) {
      if (path.rfind("extensions.added_mass", 0) != 0 || UnitOf(path) != "kg") continue;
      const std::optional<double> value = GetParameter(path, set.cable);
      if (!value || !(*value > 0)) continue;
      add("mass", "with [" + path + "]" + grams(1e-3), 1e-3, true,
          [&](MeasurementSet* changed) { SetParameter(path, 1e-3 * *value, &changed->cable); });
    }
  if (experiment.b.kind == EndCondition::Kind::kDisc) {
    const auto disc = [&](const std::string& text, double factor, double Disc::*number) {
      add("mass", text + " (factor " + FormatRounded(factor) + ")", factor, true,
          [=](MeasurementSet* changed) {
            for (Experiment& one : changed->experiments) one.b.disc.*number *= factor;
          });
    };
    if (experiment.b.disc.mass > 0) disc("with the disc's mass in grams", 1e-3, &Disc::mass);
    if (experiment.b.disc.inertia > 0)
      for (const auto& [factor, unit] :
           {std::pair<double, const char*>{1e-3, "g m^2"}, {1e-4, "kg cm^2"}, {1e-7, "g cm^2"}})
        disc(std::string("with the disc's inertia in ") + unit, factor, &Disc::inertia);
  }
  if (keys.mass_per_length.value)
    add("mass", "with [mass_per_length] in g/m (factor 0.001)", 1e-3, true,
        [](MeasurementSet* changed) {
          const auto mend = [](CableKeys* keys) {
            if (keys->mass_per_length.value) *keys->mass_per_length.value *= 1e-3;
          };
          mend(&changed->cable);
          for (Experiment& one : changed->experiments) mend(&one.specimen);
        });
  if (experiment.start.kind == StartCondition::Kind::kTwisted)
    for (const auto& [factor, text] :
         {std::pair<double, const char*>{-1, "with the sign of `twisted` turned"},
          {kRadians, "with `twisted` in degrees"}})
      add("start", text, factor, false, [&, factor = factor](MeasurementSet* changed) {
        changed->experiments[e].start.twisted *= factor;
      });
  // What the set says to be known may be off.
  if (set.cable.uncertain.value) {
    const std::string name = experiment.b.kind == EndCondition::Kind::kDisc ? "GJ" : "EI";
    const auto& names = *set.cable.uncertain.value;
    if (std::none_of(names.begin(), names.end(),
                     [&](const UncertainKey& key) { return key.name.rfind(name, 0) == 0; }) &&
        GetParameter(name, keys)) {
      add("parameter", "", 1, true, [&](MeasurementSet* changed) {
        changed->cable.uncertain.value->push_back({name, set.cable.uncertain.mark});
      });
      slips.back().named = name;
    }
  }
  return slips;
}

}  // namespace cosserat_cable
