// The numbers of extensions by their paths.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "cosserat_cable/cable/extension_law.h"
#include "extensions.h"
#include "parameter_spec.h"

namespace cosserat_cable {
namespace {

// The paths by which a field's numbers may be named: a pair's key for both directions, too.
std::vector<std::string> PathsByName(const ExtensionField& field) {
  std::vector<std::string> paths = NumberPaths(field);
  if (field.pair) paths.insert(paths.begin(), field.path);
  return paths;
}

// What the paths of an entry's, or of an item's, numbers begin with.
std::string PlaceOf(const ExtensionLaw& law, std::size_t part) {
  return ExtensionPrefix() + law.name + (law.list ? "[" + std::to_string(part) + "]." : ".");
}

// A path of an extension, taken apart.
struct Place {
  const ExtensionLaw* law = nullptr;
  const ExtensionField* field = nullptr;
  std::size_t part = 0;
  std::vector<std::string> numbers;  // their paths in the part: of both directions, two
};

std::optional<Place> Parse(const std::string& path) {
  for (const ExtensionLaw& law : ExtensionLaws()) {
    const std::string begin = ExtensionPrefix() + law.name;
    if (path.rfind(begin, 0) != 0) continue;
    Place place;
    place.law = &law;
    std::string rest = path.substr(begin.size());
    if (law.list) {
      const std::optional<std::size_t> index = TakeIndex(&rest);
      if (!index) continue;
      place.part = *index;
    }
    if (rest.empty() || rest[0] != '.') continue;
    rest.erase(0, 1);
    for (const ExtensionField& field : law.fields)
      for (const std::string& name : PathsByName(field)) {
        if (name != rest) continue;
        place.field = &field;
        const bool both = field.pair && name == field.path;
        place.numbers = both ? NumberPaths(field) : std::vector<std::string>{name};
        return place;
      }
  }
  return std::nullopt;
}

ExtensionKey* Find(const std::string& name, CableKeys* keys) {
  if (!keys->extensions.value) return nullptr;
  for (ExtensionKey& key : *keys->extensions.value)
    if (key.extension.name == name) return &key;
  return nullptr;
}

// What an entry needs besides the number that it is made for.
void FillIn(const Place& place, const CableKeys& keys, std::map<std::string, double>* numbers) {
  for (const ExtensionField& field : place.law->fields)
    for (const std::string& path : NumberPaths(field)) {
      if (field.otherwise)
        numbers->emplace(path, *field.otherwise);
      else if (field.need == ExtensionField::Need::kRequired)
        numbers->emplace(path, TypicalSize(PlaceOf(*place.law, place.part) + path, keys));
    }
}

/// Fields without which an entry with this number is none: required ones, and those of its group.
std::vector<const ExtensionField*> Needed(const Place& place) {
  const std::size_t dot = place.field->path.find('.');
  const std::string group = dot == std::string::npos ? "" : place.field->path.substr(0, dot + 1);
  std::vector<const ExtensionField*> needed;
  for (const ExtensionField& field : place.law->fields)
    if (field.need == ExtensionField::Need::kRequired ||
        (field.need == ExtensionField::Need::kInGroup && !group.empty() &&
         field.path.rfind(group, 0) == 0))
      needed.push_back(&field);
  return needed;
}

}  // namespace

bool CanBegin(const std::string& path, const std::vector<std::string>& paths) {
  const std::optional<Place> place = Parse(path);
  if (!place || place->part > 0) return false;
  for (const ExtensionField* field : Needed(*place)) {
    if (field->unit == "m" || field->unit == "rad") return false;
    const std::vector<std::string> names = PathsByName(*field);
    const bool named = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      const std::string whole = PlaceOf(*place->law, place->part) + name;
      return std::find(paths.begin(), paths.end(), whole) != paths.end();
    });
    if (!named) return false;
  }
  return true;
}

std::string TypicalEntry(const std::string& path, const CableKeys& keys) {
  constexpr double kRounded = 1e3;  // of the leading digit
  const std::optional<Place> place = Parse(path);
  if (!place) return "";
  CableKeys made;
  std::vector<const ExtensionField*> fields = Needed(*place);
  if (std::find(fields.begin(), fields.end(), place->field) == fields.end())
    fields.push_back(place->field);
  for (const ExtensionField* field : fields) {
    const std::string whole = PlaceOf(*place->law, 0) + field->path;
    // Somewhere in the middle of the cable.
    double size =
        field->path == "s" ? 0.5 * keys.length.value.value_or(0.2) : TypicalSize(whole, keys);
    const double unit = size > 0 ? std::pow(10.0, std::floor(std::log10(size))) / kRounded : 1.0;
    size = std::round(size / unit) * unit;
    for (double* number : MakeExtensionNumbers(whole, &made)) *number = size;
  }
  const CableExtension& extension = made.extensions.value->front().extension;
  return extension.name + ": " + WriteExtension(extension);
}

const std::string& ExtensionPrefix() {
  static const std::string prefix = "extensions.";
  return prefix;
}

std::vector<std::string> ExtensionPaths(const std::vector<CableExtension>& extensions) {
  std::vector<std::string> names;
  for (const CableExtension& extension : extensions) {
    const ExtensionLaw& law = LawOf(extension);
    for (std::size_t i = 0; i < extension.parts.size(); ++i)
      for (const ExtensionField& field : law.fields) {
        if (!extension.parts[i].count(NumberPaths(field).front())) continue;
        for (const std::string& path : PathsByName(field)) names.push_back(PlaceOf(law, i) + path);
      }
  }
  return names;
}

std::optional<Parameter> FindExtensionParameter(const std::string& path) {
  const std::optional<Place> place = Parse(path);
  if (!place) return std::nullopt;
  Parameter parameter = MakeParameter(path, place->field->unit, place->field->spec);
  parameter.neutral = place->field->neutral;
  return parameter;
}

std::vector<double*> ExtensionNumbers(const std::string& path, CableKeys* keys) {
  const std::optional<Place> place = Parse(path);
  ExtensionKey* key = place ? Find(place->law->name, keys) : nullptr;
  if (!key || place->part >= key->extension.parts.size()) return {};
  std::vector<double*> found;
  for (const std::string& name : place->numbers) {
    const auto number = key->extension.parts[place->part].find(name);
    if (number == key->extension.parts[place->part].end()) return {};
    found.push_back(&number->second);
  }
  return found;
}

std::vector<double*> MakeExtensionNumbers(const std::string& path, CableKeys* keys) {
  const std::optional<Place> place = Parse(path);
  if (!place) return {};
  if (!keys->extensions.value) keys->extensions.value.emplace();
  MarkAsSet(&keys->extensions.mark, "extensions");
  ExtensionKey* key = Find(place->law->name, keys);
  if (!key) {
    ExtensionKey made;
    made.extension.name = place->law->name;
    MarkAsSet(&made.mark, ExtensionPrefix() + place->law->name);
    keys->extensions.value->push_back(made);
    key = &keys->extensions.value->back();
  }
  std::vector<std::map<std::string, double>>& parts = key->extension.parts;
  if (place->part > parts.size()) return {};
  if (place->part == parts.size()) {
    parts.emplace_back();
    key->marks.resize(parts.size());
    FillIn(*place, *keys, &parts.back());
  }
  std::vector<double*> found;
  for (const std::string& name : place->numbers) found.push_back(&parts[place->part][name]);
  return found;
}

}  // namespace cosserat_cable
