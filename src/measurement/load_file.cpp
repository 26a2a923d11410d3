#include "load_file.h"

#include "arc_length.h"
#include "cosserat_cable/input/map_reader.h"
#include "time_column.h"

namespace cosserat_cable {
namespace {

void ReadConstantLoads(const YamlValue& value, const std::optional<double>& length,
                       ExperimentLoad* load) {
  for (const YamlValue& item : value.Items("a list of loads {s: ..., force: [x, y, z]}")) {
    MapReader map(item, "a load {s: ..., force: [x, y, z]}");
    const std::optional<double> s = ReadArcLength(map.Required("s"), length);
    const auto force = map.Required("force").Vector3(NumberSpec::Any("N"));
    if (s && force) load->samples.push_back({0, *s, *force});
  }
}

bool SameTimeAndPoint(const ExperimentLoad::Sample& a, const ExperimentLoad::Sample& b) {
  return a.t == b.t && a.s == b.s;
}

void ReadLoadFile(const CsvTable& table, const std::optional<double>& length, ExperimentLoad* load,
                  Problems* problems) {
  const TimeColumn times = ReadTimeColumn(table, TimeOrder::kRepeating, problems);
  load->quasi_static = times.quasi_static;
  const std::string first = times.name.empty() ? "t" : times.name;
  const std::vector<std::string> columns = {first, "s", "fx", "fy", "fz"};
  if (!CheckColumns(table, columns, "a load file", problems)) return;
  RowProblems rows(table.path, problems);
  Eigen::Matrix<Eigen::Index, 5, 1> at;
  for (int k = 0; k < 5; ++k) at[k] = *table.Find(columns[k]);
  std::size_t first_of_time = 0;
  for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
    const auto row = table.values.row(i);
    const int line = CsvTable::LineOf(i);
    ExperimentLoad::Sample sample{row[at[0]], row[at[1]], {row[at[2]], row[at[3]], row[at[4]]}};
    const std::string wrong = ArcLengthProblem(&sample.s, length);
    if (!wrong.empty()) rows.Add(line, "s", wrong);
    if (!load->samples.empty() && sample.t != load->samples.back().t)
      first_of_time = load->samples.size();
    for (std::size_t k = first_of_time; k < load->samples.size(); ++k) {
      if (!SameTimeAndPoint(load->samples[k], sample)) continue;
      rows.Add(line, first, "got a second force at this time and s, expected one");
    }
    load->samples.push_back(sample);
  }
}

}  // namespace

ExperimentLoad ReadLoad(const std::string& folder, const YamlValue& value,
                        const std::optional<double>& length, Problems* problems) {
  ExperimentLoad load;
  if (!value.given()) return load;
  if (value.IsList()) {
    ReadConstantLoads(value, length, &load);
    return load;
  }
  if (value.IsMap()) {
    value.ReportUnexpected("a list of loads, or the name of a CSV file");
    return load;
  }
  const std::optional<std::string> name = ReadFileName(value);
  if (!name) return load;
  load.file = *name;
  const std::optional<CsvTable> table = ReadCsvTable(folder, *name, value, problems);
  if (table) ReadLoadFile(*table, length, &load, problems);
  return load;
}

}  // namespace cosserat_cable
