// A record: one column per channel.
#pragma once

#include <vector>

#include "cosserat_cable/measurement/measurement_set.h"
#include "csv_table.h"

namespace cosserat_cable {

/// A channel, and where the set names its column.
struct ChannelEntry {
  Channel channel;
  YamlValue column;
};

/// Reads the record that the set names at `value`. Channels without a column, and columns without a
/// channel, are problems.
Record ReadRecord(const std::string& folder, const YamlValue& value,
                  const std::vector<ChannelEntry>& channels, Problems* problems);

}  // namespace cosserat_cable
