#include "cosserat_cable/input/map_reader.h"

#include <algorithm>
#include <set>

namespace cosserat_cable {
namespace {

// A key that is longer fills no screen.
constexpr std::size_t kLongestKey = 100;

std::string JoinPath(const std::string& map, const std::string& key) {
  const std::string shown = key.size() > kLongestKey ? key.substr(0, kLongestKey) + "..." : key;
  return map.empty() ? shown : map + "." + shown;
}

std::string Join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

MapReader::MapReader(const YamlValue& value, const std::string& expected) : value_(value) {
  if (!value_.IsMap()) {
    value_.ReportUnexpected(expected);
    return;
  }
  std::map<std::string, int> first_lines;
  for (const auto& entry : value_.node_) {
    const SourceMark& here = value_.mark();
    const int line = entry.first.Mark().line + 1;
    if (!entry.first.IsScalar()) {
      value_.problems_->Add(here.file, line, here.key,
                            "got a key that is not a text, expected one");
      continue;
    }
    const std::string& key = entry.first.Scalar();
    const YamlValue item(YamlValue::State::kGiven, entry.second,
                         {here.file, line, JoinPath(here.key, key)}, value_.problems_);
    const auto inserted = first_lines.emplace(key, line);
    if (!inserted.second) {
      item.Report("got this key a second time, expected it once: it stands on line " +
                  std::to_string(inserted.first->second) + " already");
      continue;
    }
    entries_.emplace_back(key, item);
  }
}

MapReader::~MapReader() {
  const std::set<std::string> known(known_.begin(), known_.end());
  for (const auto& [key, value] : entries_) {
    if (known.count(key) > 0) continue;
    const std::string nearest = NearestWord(key, known_);
    value.Report(nearest.empty() ? "got an unknown key, expected one of " + Join(known_)
                                 : "got an unknown key, did you mean '" + nearest + "'?");
  }
}

YamlValue MapReader::Absent(const std::string& key, YamlValue::State state) const {
  return YamlValue(state, YAML::Node(),
                   {value_.mark().file, value_.mark().line, JoinPath(value_.mark().key, key)},
                   value_.problems_);
}

YamlValue MapReader::Required(const std::string& key) {
  YamlValue value = Optional(key);
  return value.given() || !ok() ? value : Absent(key, YamlValue::State::kMissing);
}

YamlValue MapReader::Optional(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  for (const auto& entry : entries_) {
    if (entry.first == key) return entry.second;
  }
  return Absent(key, YamlValue::State::kAbsent);
}

void MapReader::Refuse(const std::string& key, const std::string& message) {
  const bool given = std::any_of(entries_.begin(), entries_.end(),
                                 [&](const auto& entry) { return entry.first == key; });
  if (given) Optional(key).Report(message);
}

std::vector<std::pair<std::string, YamlValue>> MapReader::Entries() {
  for (const auto& entry : entries_) known_.push_back(entry.first);
  return entries_;
}

}  // namespace cosserat_cable
