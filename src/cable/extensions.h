// What every extension of a cable has in common: how it is read, checked, written, and put into the
// rod.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable {

/// Reads the map of extensions; an absent or empty one has none.
CableKey<std::vector<ExtensionKey>> ReadExtensions(const YamlValue& value);

/// Reports extensions that do not go with the rest of the cable.
void CheckExtensions(const CableKeys& cable, Problems* problems);

/// Reports extensions that act over the time of a record, which a vehicle's cable does not have.
void RefuseExtensionsOfRecords(const CableKeys& cable, Problems* problems);

/// The entry as YAML on one line, without its name.
std::string WriteExtension(const CableExtension& extension);

/// What the paths of extensions' parameters begin with: "extensions.".
const std::string& ExtensionPrefix();
/// The paths of the numbers that these extensions have: "extensions.maxwell[0].EI". A quantity with
/// two directions has three.
std::vector<std::string> ExtensionPaths(const std::vector<CableExtension>& extensions);
/// See FindParameter.
std::optional<Parameter> FindExtensionParameter(const std::string& path);
/// The number of this path, or those of both directions, where it is of both; none where the keys
/// have no such number.
std::vector<double*> ExtensionNumbers(const std::string& path, CableKeys* keys);
/// The same; what is not there is made, see SetParameter.
std::vector<double*> MakeExtensionNumbers(const std::string& path, CableKeys* keys);

/// Whether a search can begin with an entry that is not there: its law has nothing that must be
/// given but what is among these paths, and nothing of that says where something is (a length, an
/// angle).
bool CanBegin(const std::string& path, const std::vector<std::string>& paths);
/// An entry with this number as YAML, all that it must have of a typical size for this cable:
/// "added_mass: {s: 0.1, mass: 0.002}". Empty where there is no such number.
std::string TypicalEntry(const std::string& path, const CableKeys& keys);

/// @throws std::invalid_argument for an extension that there is not
void EnterExtensions(const CableModel& cable, rod::RodModel* rod);

}  // namespace cosserat_cable
