// The numbers of a cable's extensions by the names that `uncertain` gives them: their paths in the
// cable file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_keys.h"

namespace cosserat_cable {

struct ExtensionNumber {
  std::string unit;
  /// The one number, or those of both directions, where the name is of both: "EI" of a file that
  /// says EI, or EI1 and EI2.
  std::vector<double*> values;
};

/// "extensions.maxwell[0].EI", "extensions.maxwell[0].EI2", "extensions.clamp_damping.a.bending".
/// Nothing where these extensions have no such number.
std::optional<ExtensionNumber> FindExtensionNumber(const std::string& name,
                                                   std::vector<ExtensionKey>* extensions);

/// The unit of the number with this name, whether a cable has it or not; "" where no extension has.
std::string ExtensionNumberUnit(const std::string& name);

}  // namespace cosserat_cable
