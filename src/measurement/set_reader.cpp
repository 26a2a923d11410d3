#include <filesystem>
#include <map>

#include "cosserat_cable/input/map_reader.h"
#include "cosserat_cable/measurement/measurement_set.h"
#include "experiment_reader.h"
#include "fault_reader.h"
#include "specimen_check.h"

namespace cosserat_cable {
namespace {

constexpr int kFormat = 1;
const char* const kSetFile = "measurement.yaml";

void ReadCable(const YamlValue& value, MeasurementSet* set, Problems* problems) {
  MapReader map(value, "a map of a cable's keys");
  set->cable = ReadCableKeys(&map);
  set->cable_mark = value.mark();
  RefuseVehicleKeys(set->cable, problems);
}

void ReadExperiments(const YamlValue& value, MeasurementSet* set, Problems* problems) {
  const std::string expected = "a list of at least one experiment";
  std::map<std::string, int> lines;
  for (const YamlValue& item : value.Items(expected)) {
    set->experiments.push_back(ReadExperiment(item, *set, problems));
    const Experiment& experiment = set->experiments.back();
    const auto inserted = lines.emplace(experiment.name, experiment.mark.line);
    if (experiment.name.empty() || inserted.second) continue;
    problems->Add({experiment.mark.file, experiment.mark.line, experiment.mark.key + ".name"},
                  "got '" + experiment.name +
                      "', expected a name of its own: the experiment on line " +
                      std::to_string(inserted.first->second) + " has it");
  }
  if (value.IsList() && set->experiments.empty()) value.ReportUnexpected(expected);
}

void ReadSet(const YamlValue& root, MeasurementSet* set, Problems* problems) {
  MapReader map(root);
  const YamlValue format = map.Required("format");
  const YamlValue cable = map.Required("cable");
  const YamlValue experiments = map.Required("experiments");
  const YamlValue faults = map.Optional("faults");
  if (!format.IsText(std::to_string(kFormat)))
    format.ReportUnexpected("1, the version of the format that is read here");
  ReadCable(cable, set, problems);
  set->cable.faults = ReadFaults(faults);
  ReadExperiments(experiments, set, problems);
  CheckFaults(*set, problems);
  CheckClampLaws(set->cable, set->experiments, problems);
  if (set->experiments.empty() && cable.IsMap())
    CheckSpecimen(set->cable, set->cable_mark, problems);
}

}  // namespace

MeasurementSet LoadMeasurementSet(const std::string& path, Problems* problems) {
  namespace fs = std::filesystem;
  MeasurementSet set;
  std::error_code ignored;  // what cannot be asked about cannot be opened either
  const fs::path file =
      fs::is_directory(path, ignored) ? fs::path(path) / kSetFile : fs::path(path);
  set.file = file.string();
  set.folder = file.has_parent_path() ? file.parent_path().string() : ".";
  Problems found;
  const YamlValue root = LoadYamlFile(file.string(), &found);
  if (root.given()) ReadSet(root, &set, &found);
  found.SortByLine();
  problems->Append(found);
  return set;
}

}  // namespace cosserat_cable
