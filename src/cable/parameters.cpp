#include "cosserat_cable/cable/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>

#include "cosserat_cable/cable/cable_key_specs.h"
#include "extensions.h"
#include "parameter_spec.h"

namespace cosserat_cable {
namespace {

using Pair = std::array<double, 2>;
using DampingPair = std::array<DampingKey, 2>;

// A key of the cable itself, that has a number or a pair of them.
struct OwnKey {
  std::string name;
  NumberSpec spec;
  CableKey<double> CableKeys::*number = nullptr;
  CableKey<Pair> CableKeys::*pair = nullptr;
  CableKey<DampingKey> CableKeys::*damping = nullptr;
  CableKey<DampingPair> CableKeys::*damping_pair = nullptr;

  bool paired() const { return pair || damping_pair; }
};

const std::vector<OwnKey>& OwnKeys() {
  const auto number = [](const char* name, const NumberSpec& spec,
                         CableKey<double> CableKeys::*key) {
    return OwnKey{name, spec, key};
  };
  const auto pair = [](const char* name, const NumberSpec& spec, CableKey<Pair> CableKeys::*key) {
    return OwnKey{name, spec, nullptr, key};
  };
  static const std::vector<OwnKey> keys = {
      number("length", LengthSpec(), &CableKeys::length),
      number("diameter", DiameterSpec(), &CableKeys::diameter),
      number("width", DiameterSpec(), &CableKeys::width),
      number("height", DiameterSpec(), &CableKeys::height),
      number("mass_per_length", MassPerLengthSpec(), &CableKeys::mass_per_length),
      pair("EI", BendingStiffnessSpec(), &CableKeys::EI),
      number("GJ", BendingStiffnessSpec(), &CableKeys::GJ),
      number("EA", AxialStiffnessSpec(), &CableKeys::EA),
      pair("GA", AxialStiffnessSpec(), &CableKeys::GA),
      {"eta_EI", BendingDampingSpec(), nullptr, nullptr, nullptr, &CableKeys::eta_EI},
      {"eta_GJ", BendingDampingSpec(), nullptr, nullptr, &CableKeys::eta_GJ},
      {"eta_EA", AxialDampingSpec(), nullptr, nullptr, &CableKeys::eta_EA},
      {"eta_GA", AxialDampingSpec(), nullptr, nullptr, nullptr, &CableKeys::eta_GA}};
  return keys;
}

// Which number a name means: of a pair both (-1), 0 or 1.
struct Own {
  const OwnKey* key = nullptr;
  int which = -1;
};

Own FindOwn(const std::string& path) {
  for (const OwnKey& key : OwnKeys()) {
    if (path == key.name) return {&key, -1};
    if (!key.paired()) continue;
    if (path == key.name + "1") return {&key, 0};
    if (path == key.name + "2") return {&key, 1};
  }
  return {};
}

std::optional<double> Known(const DampingKey& key) {
  if (key.kind != DampingKey::Kind::kNumber) return std::nullopt;
  return key.value;
}

std::optional<double> GetOwn(const Own& own, const CableKeys& keys) {
  const OwnKey& key = *own.key;
  const auto which = static_cast<std::size_t>(std::max(0, own.which));
  if (key.number) return (keys.*key.number).value;
  if (key.damping) {
    const auto& damping = (keys.*key.damping).value;
    return damping ? Known(*damping) : std::nullopt;
  }
  if (key.pair) {
    const auto& pair = (keys.*key.pair).value;
    return pair ? std::optional<double>((*pair)[which]) : std::nullopt;
  }
  const auto& pair = (keys.*key.damping_pair).value;
  return pair ? Known((*pair)[which]) : std::nullopt;
}

bool GivesOwn(const Own& own, const CableKeys& keys) {
  const OwnKey& key = *own.key;
  if (key.number) return (keys.*key.number).given();
  if (key.damping) return (keys.*key.damping).given();
  if (key.pair) return (keys.*key.pair).given();
  return (keys.*key.damping_pair).given();
}

void SetPair(int which, double value, Pair* both) {
  if (which >= 0) {
    (*both)[static_cast<std::size_t>(which)] = value;
    return;
  }
  // Of two that are equal, exactly one: they stay so to the last bit.
  const double ratio = (*both)[1] / (*both)[0];
  *both = {value, value * ratio};
}

void SetPair(int which, double value, DampingPair* both) {
  const DampingKey number{DampingKey::Kind::kNumber, value};
  if (which >= 0) {
    (*both)[static_cast<std::size_t>(which)] = number;
    return;
  }
  const std::optional<double> first = Known((*both)[0]), second = Known((*both)[1]);
  const double ratio = first && second && *first > 0 ? *second / *first : 1.0;
  *both = {number, {DampingKey::Kind::kNumber, value * ratio}};
}

void SetOwn(const Own& own, double value, CableKeys* keys) {
  const OwnKey& key = *own.key;
  const DampingKey number{DampingKey::Kind::kNumber, value};
  const auto set = [&](auto* entry, const auto& made) {
    if (!entry->value) entry->value = made;
    SetPair(own.which, value, &*entry->value);
    MarkAsSet(&entry->mark, key.name);
  };
  const auto set_one = [&](auto* entry, const auto& made) {
    entry->value = made;
    MarkAsSet(&entry->mark, key.name);
  };
  if (key.number) set_one(&(keys->*key.number), value);
  if (key.damping) set_one(&(keys->*key.damping), number);
  if (key.pair) set(&(keys->*key.pair), Pair{value, value});
  if (key.damping_pair) set(&(keys->*key.damping_pair), DampingPair{number, number});
}

bool IsViscous(const std::string& unit) {
  static const std::vector<std::string> units = {"N m^2 s", "N s", "N m s", "N m s/rad", "1/s"};
  return std::find(units.begin(), units.end(), unit) != units.end();
}

bool IsOfExtension(const std::string& path) { return path.rfind(ExtensionPrefix(), 0) == 0; }

// The scales of a cable, of an ordinary one where nothing is known.
struct Scales {
  explicit Scales(const CableKeys& keys)
      : L(keys.length.value.value_or(0.2)),
        rhoA(keys.mass_per_length.value.value_or(0.1)),
        EI(GetParameter("EI", keys).value_or(0.01)),
        GJ(GetParameter("GJ", keys).value_or(EI)),
        EA(GetParameter("EA", keys).value_or(EI / Gyration(keys))),
        w(BendingFrequency(keys)) {}
  static double Gyration(const CableKeys& keys) {
    const SectionShape shape = ShapeOf(keys).value_or(SectionShape{0.01, 0, 0});
    return std::min(shape.gyration1(), shape.gyration2());
  }
  double L, rhoA, EI, GJ, EA;  // [m], [kg/m], [N m^2], [N m^2], [N]
  double w;                    // of the slowest bending [rad/s]
};

}  // namespace

Parameter MakeParameter(const std::string& path, const std::string& unit, const NumberSpec& spec) {
  Parameter parameter;
  parameter.path = path;
  parameter.unit = unit;
  parameter.lower = spec.low();
  parameter.upper = spec.high();
  if (spec.low() < 0)
    parameter.sign = ParameterSign::kSigned;
  else if (spec.low() == 0 && spec.low_belongs())
    parameter.sign = ParameterSign::kNonNegative;
  parameter.damping = IsViscous(unit);
  return parameter;
}

std::optional<std::size_t> TakeIndex(std::string* path) {
  if (path->empty() || (*path)[0] != '[') return std::nullopt;
  const std::size_t end = path->find(']');
  if (end == std::string::npos) return std::nullopt;
  std::size_t index = 0;
  const char *first = path->data() + 1, *last = path->data() + end;
  const std::from_chars_result read = std::from_chars(first, last, index);
  if (read.ec != std::errc() || read.ptr != last) return std::nullopt;
  path->erase(0, end + 1);
  return index;
}

void MarkAsSet(SourceMark* mark, const std::string& key) {
  if (mark->line == 0) *mark = {"identified", 1, key};
}

bool IsFault(const std::string& path) { return path.rfind(FaultPrefix(), 0) == 0; }
bool IsOfEntry(const std::string& path) { return IsFault(path) || IsOfExtension(path); }

std::optional<Parameter> FindParameter(const std::string& path) {
  if (IsOfExtension(path)) return FindExtensionParameter(path);
  if (IsFault(path)) return FindFaultParameter(path);
  if (path == kDiscInertia)
    return MakeParameter(path, "kg m^2", NumberSpec::Above(0, "kg m^2").AtMost(1e3));
  const Own own = FindOwn(path);
  if (!own.key) return std::nullopt;
  return MakeParameter(path, own.key->spec.unit(), own.key->spec);
}

std::string UnitOf(const std::string& path) {
  const std::optional<Parameter> found = FindParameter(path);
  return found ? found->unit : "";
}

std::vector<std::string> ParameterPaths(const CableKeys& keys) {
  std::vector<std::string> paths;
  for (const OwnKey& key : OwnKeys()) {
    paths.push_back(key.name);
    if (!key.paired()) continue;
    paths.push_back(key.name + "1");
    paths.push_back(key.name + "2");
  }
  paths.emplace_back(kDiscInertia);
  if (!keys.extensions.value) return paths;
  std::vector<CableExtension> extensions;
  for (const ExtensionKey& key : *keys.extensions.value) extensions.push_back(key.extension);
  const std::vector<std::string> more = ExtensionPaths(extensions);
  paths.insert(paths.end(), more.begin(), more.end());
  return paths;
}

std::optional<double> GetParameter(const std::string& path, const CableKeys& keys) {
  if (const Own own = FindOwn(path); own.key) return GetOwn(own, keys);
  CableKeys copy = keys;
  if (IsFault(path)) {
    const double* number = FaultNumber(path, &copy);
    return number ? std::optional<double>(*number) : std::nullopt;
  }
  const std::vector<double*> numbers = ExtensionNumbers(path, &copy);
  return numbers.empty() ? std::nullopt : std::optional<double>(*numbers.front());
}

bool GivesParameter(const std::string& path, const CableKeys& keys) {
  if (const Own own = FindOwn(path); own.key) return GivesOwn(own, keys);
  return GetParameter(path, keys).has_value();
}

bool IsUnknownParameter(const std::string& path, const CableKeys& keys) {
  constexpr auto kUnknown = DampingKey::Kind::kUnknown;
  const Own own = FindOwn(path);
  if (!own.key) return false;
  if (own.key->damping) {
    const auto& damping = (keys.*own.key->damping).value;
    return damping && damping->kind == kUnknown;
  }
  if (!own.key->damping_pair) return false;
  const auto& pair = (keys.*own.key->damping_pair).value;
  return pair && (*pair)[static_cast<std::size_t>(std::max(0, own.which))].kind == kUnknown;
}

void SetParameter(const std::string& path, double value, CableKeys* keys) {
  if (const Own own = FindOwn(path); own.key) return SetOwn(own, value, keys);
  if (IsFault(path)) {
    if (double* number = MakeFaultNumber(path, keys)) {
      *number = value;
      return;
    }
  }
  const std::vector<double*> numbers = MakeExtensionNumbers(path, keys);
  if (numbers.empty()) throw std::invalid_argument("'" + path + "' is no parameter of this cable");
  // The second direction goes with the first in proportion.
  if (numbers.size() == 2)
    *numbers[1] = *numbers[0] == 0 ? value : value * (*numbers[1] / *numbers[0]);
  *numbers[0] = value;
}

double BendingFrequency(const CableKeys& keys) {
  constexpr double kFirstClampedFree = 1.87510407;  // root of 1 + cos cosh = 0
  const double L = keys.length.value.value_or(0.2), EI = GetParameter("EI", keys).value_or(0.01);
  return std::pow(kFirstClampedFree / L, 2) *
         std::sqrt(EI / keys.mass_per_length.value.value_or(0.1));
}

double TypicalSize(const std::string& path, const CableKeys& keys) {
  const std::optional<Parameter> parameter = FindParameter(path);
  if (!parameter) return 0;
  const Scales c(keys);
  const bool twist = path.find("GJ") != std::string::npos;
  const double stiffness = twist ? c.GJ : c.EI;
  const double loss = 2 * kTypicalDamping / c.w;  // [s]: viscous loss by stiffness
  constexpr double kMarked = 0.1;                 // of what it is a part of
  const std::map<std::string, double> sizes = {{"", kMarked},
                                               {"m", kMarked * c.L},
                                               {"1/m", kMarked / c.L},
                                               {"rad", kMarked},
                                               {"rad/m", kMarked / c.L},
                                               {"kg", kMarked * c.rhoA * c.L},
                                               {"kg/m", c.rhoA},
                                               {"kg m^2", kMarked * c.rhoA * std::pow(c.L, 3)},
                                               {"s", 1 / c.w},
                                               {"1/s", 2 * kTypicalDamping * c.w},
                                               {"Hz", c.w},  // some six times the first bending's
                                               {"N m^2", stiffness},
                                               {"N m^2 s", loss * stiffness},
                                               {"N", c.EA},
                                               {"N s", loss * c.EA},
                                               {"N m", kMarked * c.EI / c.L},
                                               {"N m/rad", 10 * c.EI / c.L},
                                               {"N m s", loss * c.EI / c.L},
                                               {"N m s/rad", loss * c.EI / c.L},
                                               {"N/m", 1e3 * c.EI / std::pow(c.L, 3)}};
  // The record's time is cut finer than a swing.
  if (path.rfind(FaultPrefix() + "clock.", 0) == 0)
    return parameter->unit.empty() ? 0.1 * kMarked : kMarked / c.w;
  const auto found = sizes.find(parameter->unit);
  return found == sizes.end() ? 1.0 : found->second;
}

}  // namespace cosserat_cable
