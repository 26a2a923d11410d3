#include "record_file.h"

#include <algorithm>

#include "time_column.h"

namespace cosserat_cable {
namespace {

bool IsNamed(const std::string& column, const std::vector<ChannelEntry>& channels) {
  return std::any_of(channels.begin(), channels.end(),
                     [&](const ChannelEntry& entry) { return entry.channel.column == column; });
}

}  // namespace

Record ReadRecord(const std::string& folder, const YamlValue& value,
                  const std::vector<ChannelEntry>& channels, Problems* problems) {
  Record record;
  const std::optional<std::string> name = ReadFileName(value);
  if (!name) return record;
  record.file = *name;
  const std::optional<CsvTable> table = ReadCsvTable(folder, *name, value, problems);
  if (!table) return record;
  const TimeColumn times = ReadTimeColumn(*table, TimeOrder::kIncreasing, problems);
  record.quasi_static = times.quasi_static;
  record.t = times.t;

  std::vector<std::string> unnamed;
  for (std::size_t i = times.name.empty() ? 0 : 1; i < table->columns.size(); ++i) {
    const std::string& column = table->columns[i];
    if (IsNamed(column, channels)) continue;
    unnamed.push_back(column);
    problems->Add(table->path, 1, column, "got a column that no channel names, expected one");
  }
  record.values.resize(table->values.rows(), static_cast<Eigen::Index>(channels.size()));
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const std::string& column = channels[k].channel.column;
    const std::optional<Eigen::Index> at = table->Find(column);
    if (at && (*at > 0 || times.name.empty())) {
      record.values.col(static_cast<Eigen::Index>(k)) = table->values.col(*at);
    } else if (at) {
      channels[k].column.ReportUnexpected("a column of values: this one holds the times");
    } else {
      const std::string nearest = NearestWord(column, unnamed);
      channels[k].column.ReportUnexpected(
          "a column of " + *name + (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
    }
  }
  return record;
}

}  // namespace cosserat_cable
