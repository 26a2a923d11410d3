// What the families of parameters share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/input/number_spec.h"

namespace cosserat_cable {

/// Its sign and range are those of what a file may give.
Parameter MakeParameter(const std::string& path, const std::string& unit, const NumberSpec& spec);

/// Takes "[3]" from the front of a path.
std::optional<std::size_t> TakeIndex(std::string* path);

/// What a file does not have gets a mark of its own, so that it counts as given.
void MarkAsSet(SourceMark* mark, const std::string& key);

/// What is said of `faults` in a cable's keys, or in a cable file.
inline constexpr const char* kFaultsOfACable =
    "got faults of a record, expected them in a measurement set (measurement.yaml): beside its "
    "`cable`, or of one experiment";

/// Entries of `faults`.
inline constexpr const char* kFaultNames[] = {"clock", "sensor", "base_motion"};

/// What the paths of faults begin with: "faults.".
const std::string& FaultPrefix();
std::optional<Parameter> FindFaultParameter(const std::string& path);
/// Null where the keys have no such entry.
double* FaultNumber(const std::string& path, CableKeys* keys);
/// The same; an entry that is not there is made, with all of its numbers neutral.
double* MakeFaultNumber(const std::string& path, CableKeys* keys);

}  // namespace cosserat_cable
