// What every extension of a cable has in common: how it is read, checked, written, and put into the
// rod.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable {

/// Reads the map of extensions; an absent or empty one has none.
CableKey<std::vector<ExtensionKey>> ReadExtensions(const YamlValue& value);

/// Reports extensions that do not go with the rest of the cable.
void CheckExtensions(const CableKeys& cable, Problems* problems);

/// The entry as YAML on one line, without its name.
std::string WriteExtension(const CableExtension& extension);

/// The extensions' numbers as `uncertain` names them: "extensions.maxwell[0].EI". A quantity with
/// two directions has three names.
std::vector<std::string> ExtensionNumberNames(const std::vector<CableExtension>& extensions);
/// What these names begin with.
const std::string& ExtensionNumberPrefix();

/// @throws std::invalid_argument for an extension that there is not
void EnterExtensions(const CableModel& cable, rod::RodModel* rod);

}  // namespace cosserat_cable
