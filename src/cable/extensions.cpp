#include "extensions.h"

#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>

#include "cosserat_cable/cable/extension_law.h"
#include "cosserat_cable/input/number_text.h"
#include "parameter_spec.h"
#include "read_pair.h"

namespace cosserat_cable {
namespace {

// "a" and "bending" of "a.bending"; "" and "tau" of "tau".
std::pair<std::string, std::string> SplitPath(const std::string& path) {
  const std::size_t dot = path.find('.');
  if (dot == std::string::npos) return {"", path};
  return {path.substr(0, dot), path.substr(dot + 1)};
}

// One entry, or one item of a list: a map with the fields of its law.
class PartReader {
 public:
  PartReader(const ExtensionLaw& law, const YamlValue& value, ExtensionKey* key)
      : law_(law), map_(value, law.shape), key_(key) {
    key_->extension.parts.emplace_back();
    key_->marks.emplace_back();
    whole_ = map_.ok();
    bool any = false, any_needed = false;
    for (const ExtensionField& field : law.fields) {
      const bool given = Read(field);
      if (field.need != ExtensionField::Need::kAny && field.need != ExtensionField::Need::kInGroup)
        continue;
      any_needed = true;
      any = any || given || GroupGiven(field);
    }
    if (whole_ && any_needed && !any) value.Report("got nothing that acts, expected " + Any());
  }

 private:
  bool Read(const ExtensionField& field) {
    const auto [group, name] = SplitPath(field.path);
    MapReader* map = Group(group);
    const std::vector<std::string> paths = NumberPaths(field);
    CableKey<std::array<double, 2>> found;
    const auto parse = [&field](const YamlValue& value) { return value.Number(field.spec); };
    if (field.pair) {
      found = ReadPair<double>(map, name, parse);
    } else {
      const bool required = field.need == ExtensionField::Need::kRequired || GroupGiven(field);
      const YamlValue value = required ? map->Required(name) : map->Optional(name);
      if (value.given()) found.mark = value.mark();
      if (const std::optional<double> number = parse(value)) found.value = {*number, *number};
    }
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (found.given()) key_->marks.back()[paths[i]] = found.mark;
      if (found.value)
        key_->extension.parts.back()[paths[i]] = (*found.value)[i];
      else if (field.otherwise)
        key_->extension.parts.back()[paths[i]] = *field.otherwise;
    }
    return found.given();
  }

  /// Whether a field that its map requires has that map.
  bool GroupGiven(const ExtensionField& field) const {
    return field.need == ExtensionField::Need::kInGroup &&
           given_groups_.count(SplitPath(field.path).first) > 0;
  }

  MapReader* Group(const std::string& name) {
    if (name.empty()) return &map_;
    std::unique_ptr<MapReader>& group = groups_[name];
    if (!group) {
      const YamlValue value = map_.Optional(name);
      if (value.given()) given_groups_.insert(name);
      group = std::make_unique<MapReader>(value);
      whole_ = whole_ && (group->ok() || !value.given());
    }
    return group.get();
  }

  std::string Any() const {
    std::string paths;
    std::set<std::string> named;
    for (const ExtensionField& field : law_.fields) {
      const bool whole_group = field.need == ExtensionField::Need::kInGroup;
      if (field.need != ExtensionField::Need::kAny && !whole_group) continue;
      const std::string path = whole_group ? SplitPath(field.path).first : field.path;
      if (named.insert(path).second) paths += (paths.empty() ? "at least one of " : ", ") + path;
    }
    return paths;
  }

  const ExtensionLaw& law_;
  MapReader map_;
  std::map<std::string, std::unique_ptr<MapReader>> groups_;
  std::set<std::string> given_groups_;
  ExtensionKey* key_;
  bool whole_ = true;  // all is there that its keys stand in
};

ExtensionKey ReadExtension(const ExtensionLaw& law, const YamlValue& value) {
  ExtensionKey key;
  key.extension.name = law.name;
  key.mark = value.mark();
  if (!law.list) {
    PartReader(law, value, &key);
    return key;
  }
  const std::string expected = "a list, each item " + law.shape;
  const std::vector<YamlValue> items = value.Items(expected);
  for (const YamlValue& item : items) PartReader(law, item, &key);
  if (value.IsList() && items.empty()) value.ReportUnexpected(expected);
  return key;
}

// A field as "key: value", or "key1: value, key2: value"; nothing where it is absent.
std::string WriteField(const ExtensionField& field, const std::map<std::string, double>& numbers) {
  const std::string key = SplitPath(field.path).second;
  const std::vector<std::string> paths = NumberPaths(field);
  if (!numbers.count(paths.front())) return "";
  const double first = numbers.at(paths.front()), last = numbers.at(paths.back());
  if (first == last) return key + ": " + FormatNumber(first);
  return key + "1: " + FormatNumber(first) + ", " + key + "2: " + FormatNumber(last);
}

std::string WritePart(const ExtensionLaw& law, const std::map<std::string, double>& numbers) {
  std::vector<std::pair<std::string, std::string>> groups;  // in the order of the law's fields
  for (const ExtensionField& field : law.fields) {
    const std::string text = WriteField(field, numbers);
    const std::string group = SplitPath(field.path).first;
    if (text.empty()) continue;
    if (groups.empty() || groups.back().first != group)
      groups.emplace_back(group, text);
    else
      groups.back().second += ", " + text;
  }
  std::string all;
  for (const auto& [group, text] : groups) {
    if (!all.empty()) all += ", ";
    all += group.empty() ? text : group + ": {" + text + "}";
  }
  return "{" + all + "}";
}

}  // namespace

const ExtensionLaw& LawOf(const CableExtension& extension) {
  for (const ExtensionLaw& law : ExtensionLaws())
    if (law.name == extension.name) return law;
  throw std::invalid_argument("a cable cannot have the extension '" + extension.name + "'");
}

std::vector<std::string> NumberPaths(const ExtensionField& field) {
  if (!field.pair) return {field.path};
  return {field.path + "1", field.path + "2"};
}

CableKey<std::vector<ExtensionKey>> ReadExtensions(const YamlValue& value) {
  if (!value.given()) return {};
  std::vector<ExtensionKey> keys;
  if (value.IsEmpty()) return {keys, value.mark()};
  MapReader map(value, "a map of extensions by name");
  for (const ExtensionLaw& law : ExtensionLaws()) {
    const YamlValue entry = map.Optional(law.name);
    if (entry.given()) keys.push_back(ReadExtension(law, entry));
  }
  for (const char* fault : kFaultNames)
    map.Refuse(fault, std::string("got a fault of a record among the cable's extensions, expected "
                                  "it in a measurement set (measurement.yaml): `faults: {") +
                          fault + ": ...}` beside its `cable`, or in one experiment");
  map.Refuse("faults", kFaultsOfACable);
  return {keys, value.mark()};
}

void CheckExtensions(const CableKeys& cable, Problems* problems) {
  if (!cable.extensions.value) return;
  for (const ExtensionKey& key : *cable.extensions.value)
    if (const ExtensionLaw& law = LawOf(key.extension); law.check) law.check(key, cable, problems);
}

void RefuseExtensionsOfRecords(const CableKeys& cable, Problems* problems) {
  if (!cable.extensions.value) return;
  for (const ExtensionKey& key : *cable.extensions.value)
    if (LawOf(key.extension).of_record)
      problems->Add(key.mark, "got " + key.extension.name +
                                  ", a change over the time of a record, of a vehicle's cable, "
                                  "expected it in the `cable` of a measurement set "
                                  "(measurement.yaml)");
}

std::string WriteExtension(const CableExtension& extension) {
  const ExtensionLaw& law = LawOf(extension);
  std::string text;
  for (const auto& numbers : extension.parts)
    text += (text.empty() ? "" : ", ") + WritePart(law, numbers);
  return law.list ? "[" + text + "]" : text;
}

void EnterExtensions(const CableModel& cable, rod::RodModel* rod) {
  for (const CableExtension& extension : cable.extensions) {
    const ExtensionLaw& law = LawOf(extension);
    if (law.enter) law.enter(extension, rod);
    if (!law.load) continue;
    if (auto load = law.load(extension, cable)) rod->loads.push_back(std::move(load));
  }
}

}  // namespace cosserat_cable
