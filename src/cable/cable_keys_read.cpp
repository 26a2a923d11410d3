#include <algorithm>
#include <set>

#include "cosserat_cable/cable/cable_key_specs.h"
#include "cosserat_cable/cable/cable_keys.h"
#include "extensions.h"
#include "parameter_spec.h"
#include "read_pair.h"

namespace cosserat_cable {
namespace {

constexpr int kFewestElements = 4;
constexpr int kMostElements = 1000;

enum class Critical { kKnown, kNone };

std::optional<DampingKey> ParseDamping(const YamlValue& value, const NumberSpec& spec,
                                       Critical critical) {
  if (value.IsNull()) return DampingKey{DampingKey::Kind::kUnknown, 0};
  if (value.IsText("critical")) {
    if (critical == Critical::kKnown) return DampingKey{DampingKey::Kind::kCritical, 0};
    value.ReportUnexpected(spec.Expected() + ": eq. (10) gives no critical damping in bending");
    return std::nullopt;
  }
  NumberSpec expected = spec;
  if (critical == Critical::kKnown) expected.Or("'critical'");
  const std::optional<double> number = value.Number(expected);
  if (!number) return std::nullopt;
  return DampingKey{DampingKey::Kind::kNumber, *number};
}

CableKey<double> ReadNumber(const YamlValue& value, const NumberSpec& spec) {
  if (!value.given()) return {};
  return {value.Number(spec), value.mark()};
}

CableKey<std::vector<LumpedMassKey>> ReadMasses(const YamlValue& value) {
  if (!value.given()) return {};
  std::vector<LumpedMassKey> masses;
  for (const YamlValue& item : value.Items("a list of masses {s: ..., mass: ...}")) {
    MapReader map(item, "a mass {s: ..., mass: ...}");
    const YamlValue s = map.Required("s");
    const std::optional<double> s_value = s.Number(ArcLengthSpec());
    const std::optional<double> mass = map.Required("mass").Number(LumpedMassSpec());
    if (s_value && mass) masses.push_back({{*s_value, *mass}, s.mark()});
  }
  return {masses, value.mark()};
}

CableKey<std::vector<UncertainKey>> ReadUncertain(const YamlValue& value) {
  if (!value.given()) return {};
  std::vector<UncertainKey> keys;
  for (const YamlValue& item : value.Items("a list of the names of numeric keys")) {
    // Which numbers extensions and faults have is known once all has been read.
    const bool later = item.Shown().rfind("'" + ExtensionPrefix(), 0) == 0 ||
                       item.Shown().rfind("'" + FaultPrefix(), 0) == 0;
    if (item.IsText("D_E")) {
      item.Report(std::string("got 'D_E', expected it by its path: '") + kEndDamping + "'");
      continue;
    }
    const auto key = later ? item.Text() : item.OneOf(ParameterPaths({}));
    if (key) keys.push_back({*key, item.mark()});
  }
  return {keys, value.mark()};
}

// A link's name, or a map with what else is to be said of it.
std::optional<LinkKey> ReadAvoided(const YamlValue& item) {
  const std::string expected = "the name of a link";
  if (!item.IsMap()) {
    const std::optional<std::string> name = item.Text(expected);
    if (!name) return std::nullopt;
    return LinkKey{*name, item.mark(), std::nullopt};
  }
  MapReader map(item, "a link {link: ..., use_visual: ...}");
  const YamlValue link = map.Required("link");
  const std::optional<std::string> name = link.Text(expected);
  const std::optional<bool> use_visual = map.Optional("use_visual").Flag();
  if (!name) return std::nullopt;
  return LinkKey{*name, link.mark(), use_visual};
}

CableKey<bool> ReadUseVisual(const YamlValue& value) {
  if (!value.given()) return {};
  return {value.Flag(), value.mark()};
}

CableKey<std::vector<LinkKey>> ReadAvoid(const YamlValue& value) {
  if (!value.given()) return {};
  std::vector<LinkKey> links;
  std::set<std::string> names;
  for (const YamlValue& item : value.Items("a list of links")) {
    std::optional<LinkKey> link = ReadAvoided(item);
    if (!link) continue;
    if (!names.insert(link->name).second)
      item.Report("got '" + link->name + "' twice, expected it once");
    links.push_back(std::move(*link));
  }
  return {links, value.mark()};
}

CableKey<double> ReadApex(const YamlValue& value) {
  MapReader map(value, "a point {s: ...}");
  const YamlValue s = map.Required("s");
  if (!value.given()) return {};
  return {s.Number(ArcLengthSpec()), s.mark()};
}

CableKey<ContactKey> ReadContact(const YamlValue& value) {
  MapReader map(value, "a law {stiffness: ..., smoothing: ..., damping: ...}");
  ContactKey law;
  law.stiffness = map.Optional("stiffness").Number(ContactStiffnessSpec());
  law.smoothing = map.Optional("smoothing").Number(ContactSmoothingSpec()).value_or(law.smoothing);
  law.damping = map.Optional("damping").Number(ContactDampingSpec()).value_or(law.damping);
  if (!value.given()) return {};
  return {law, value.mark()};
}

void ReadShape(MapReader* map, CableKeys* keys) {
  const YamlValue diameter = map->Optional("diameter");
  const YamlValue width = map->Optional("width"), height = map->Optional("height");
  keys->diameter = ReadNumber(diameter, DiameterSpec());
  keys->width = ReadNumber(width, DiameterSpec());
  keys->height = ReadNumber(height, DiameterSpec());
  const YamlValue& one = width.given() ? width : height;
  if (diameter.given())
    one.Report("got this beside diameter, expected either diameter, or width and height");
  else if (width.given() != height.given())
    one.Report("got this alone, expected width and height, or diameter");
}

template <typename T>
void Fill(CableKey<T>* key, const CableKey<T>& other) {
  if (!key->given()) *key = other;
}

}  // namespace

CableKeys ReadCableKeys(MapReader* map) {
  CableKeys keys;
  keys.length = ReadNumber(map->Optional("length"), LengthSpec());
  ReadShape(map, &keys);
  keys.mass_per_length = ReadNumber(map->Optional("mass_per_length"), MassPerLengthSpec());
  keys.EI = ReadPair<double>(
      map, "EI", [](const YamlValue& value) { return value.Number(BendingStiffnessSpec()); });
  keys.GJ = ReadNumber(map->Optional("GJ"), BendingStiffnessSpec());
  keys.EA = ReadNumber(map->Optional("EA"), AxialStiffnessSpec());
  keys.GA = ReadPair<double>(
      map, "GA", [](const YamlValue& value) { return value.Number(AxialStiffnessSpec()); });

  const auto read_damping = [map](const std::string& key, const NumberSpec& spec) {
    const YamlValue value = map->Optional(key);
    if (!value.given()) return CableKey<DampingKey>();
    return CableKey<DampingKey>{ParseDamping(value, spec, Critical::kKnown), value.mark()};
  };
  keys.eta_EI = ReadPair<DampingKey>(map, "eta_EI", [](const YamlValue& value) {
    return ParseDamping(value, BendingDampingSpec(), Critical::kNone);
  });
  keys.eta_GJ = read_damping("eta_GJ", BendingDampingSpec());
  keys.eta_EA = read_damping("eta_EA", AxialDampingSpec());
  keys.eta_GA = ReadPair<DampingKey>(map, "eta_GA", [](const YamlValue& value) {
    return ParseDamping(value, AxialDampingSpec(), Critical::kKnown);
  });

  keys.masses = ReadMasses(map->Optional("masses"));
  keys.uncertain = ReadUncertain(map->Optional("uncertain"));
  keys.apex_s = ReadApex(map->Optional("apex"));
  const YamlValue elements = map->Optional("elements");
  if (elements.given()) {
    keys.elements = {elements.Integer(kFewestElements, kMostElements), elements.mark()};
  }
  keys.avoid = ReadAvoid(map->Optional("avoid"));
  keys.use_visual = ReadUseVisual(map->Optional("use_visual"));
  keys.contact = ReadContact(map->Optional("contact"));
  keys.extensions = ReadExtensions(map->Optional("extensions"));
  map->Refuse("faults", kFaultsOfACable);
  return keys;
}

void CableKeys::FillFrom(const CableKeys& other) {
  Fill(&length, other.length);
  if (!diameter.given() && !width.given() && !height.given()) {
    diameter = other.diameter;
    width = other.width;
    height = other.height;
  }
  Fill(&mass_per_length, other.mass_per_length);
  Fill(&EI, other.EI);
  Fill(&GJ, other.GJ);
  Fill(&EA, other.EA);
  Fill(&GA, other.GA);
  Fill(&eta_EI, other.eta_EI);
  Fill(&eta_GJ, other.eta_GJ);
  Fill(&eta_EA, other.eta_EA);
  Fill(&eta_GA, other.eta_GA);
  Fill(&masses, other.masses);
  Fill(&uncertain, other.uncertain);
  Fill(&apex_s, other.apex_s);
  Fill(&elements, other.elements);
  Fill(&avoid, other.avoid);
  Fill(&use_visual, other.use_visual);
  Fill(&contact, other.contact);
  Fill(&extensions, other.extensions);
  Fill(&faults, other.faults);
}

}  // namespace cosserat_cable
