// Reads a YAML map key by key, and says which keys were never asked for.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/input/yaml_value.h"

namespace cosserat_cable {

/// Asking for a key makes it a known one. When the reader goes out of scope, every key that was
/// not asked for is a problem, with the nearest known key: so ask for all keys, also those that
/// another one makes unnecessary, before returning early.
class MapReader {
 public:
  /// A value that is not a map is a problem, and so is a key that stands in it twice; the first
  /// one counts. An absent value reads like a map that says nothing, without a complaint.
  /// @param expected what is said to be expected where it is not a map
  explicit MapReader(const YamlValue& value, const std::string& expected = "a map of keys");
  ~MapReader();
  MapReader(const MapReader&) = delete;
  MapReader& operator=(const MapReader&) = delete;

  /// The key's value; where it is absent, the reader of its type says that it is missing.
  YamlValue Required(const std::string& key);
  /// The key's value, or an absent one.
  YamlValue Optional(const std::string& key);
  /// Reports a key that belongs elsewhere, where it is given; it is not among those that are said to
  /// be expected.
  void Refuse(const std::string& key, const std::string& message);
  /// All entries of a map whose keys are names that the user chooses, in the order of the file.
  std::vector<std::pair<std::string, YamlValue>> Entries();

  /// The map's own place.
  const SourceMark& mark() const { return value_.mark(); }
  /// True where it is a map.
  bool ok() const { return value_.IsMap(); }

 private:
  YamlValue Absent(const std::string& key, YamlValue::State state) const;

  YamlValue value_;
  std::vector<std::pair<std::string, YamlValue>> entries_;  // in the order of the file
  std::vector<std::string> known_;
};

}  // namespace cosserat_cable
