// What a column of a record means, as a set says it.
#pragma once

#include <vector>

#include "record_file.h"

namespace cosserat_cable {

/// Reads an experiment's `channels`. @param length the cable's [m], where it is known
std::vector<ChannelEntry> ReadChannels(const YamlValue& value, const std::optional<double>& length);

}  // namespace cosserat_cable
