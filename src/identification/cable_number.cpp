#include "cable_number.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "cosserat_cable/cable/extension_number.h"

namespace cosserat_cable {
namespace {

using Pair = std::array<double, 2>;
using DampingPair = std::array<DampingKey, 2>;

/// A key that the set does not have gets a mark of its own, so that it counts as given.
void Give(SourceMark* mark, const std::string& name) {
  if (mark->line == 0) *mark = {"identified", 1, name};
}

CableKey<double>* Single(const std::string& name, CableKeys* keys) {
  if (name == "length") return &keys->length;
  if (name == "diameter") return &keys->diameter;
  if (name == "mass_per_length") return &keys->mass_per_length;
  if (name == "GJ") return &keys->GJ;
  if (name == "EA") return &keys->EA;
  return nullptr;
}

CableKey<DampingKey>* SingleDamping(const std::string& name, CableKeys* keys) {
  if (name == "eta_GJ") return &keys->eta_GJ;
  if (name == "eta_EA") return &keys->eta_EA;
  return nullptr;
}

/// Which of a pair a name means: -1 both, 0 or 1.
template <class T>
struct InPair {
  CableKey<T>* key = nullptr;
  int which = -1;
};

template <class T>
InPair<T> FindInPair(const std::string& name, const std::string& base, CableKey<T>* key) {
  if (name == base) return {key, -1};
  if (name == base + "1") return {key, 0};
  if (name == base + "2") return {key, 1};
  return {};
}

InPair<Pair> StiffnessPair(const std::string& name, CableKeys* keys) {
  if (const auto found = FindInPair(name, "EI", &keys->EI); found.key) return found;
  return FindInPair(name, "GA", &keys->GA);
}
InPair<DampingPair> DampingInPair(const std::string& name, CableKeys* keys) {
  if (const auto found = FindInPair(name, "eta_EI", &keys->eta_EI); found.key) return found;
  return FindInPair(name, "eta_GA", &keys->eta_GA);
}

/// A number of an extension: "extensions.maxwell[0].EI". Empty: there is none.
std::vector<double*> ExtensionNumbers(const std::string& name, CableKeys* keys) {
  if (!keys->extensions.value) return {};
  const auto found = FindExtensionNumber(name, &*keys->extensions.value);
  return found ? found->values : std::vector<double*>();
}

constexpr const char* kDashpotLaw = "clamp_damping";

double* Dashpot(CableKeys* keys, bool make) {
  if (!keys->extensions.value) {
    if (!make) return nullptr;
    keys->extensions.value.emplace();
    Give(&keys->extensions.mark, "extensions");
  }
  for (ExtensionKey& key : *keys->extensions.value)
    if (key.extension.name == kDashpotLaw) {
      auto& numbers = key.extension.parts.front();
      if (!make && !numbers.count(kDiscDashpot)) return nullptr;
      return &numbers[kDiscDashpot];
    }
  if (!make) return nullptr;
  ExtensionKey key;
  key.extension.name = kDashpotLaw;
  key.extension.parts.push_back({{kDiscDashpot, 0.0}});
  key.mark = {"identified", 1, std::string("extensions.") + kDashpotLaw};
  key.marks.resize(1);
  keys->extensions.value->push_back(key);
  return &keys->extensions.value->back().extension.parts.front()[kDiscDashpot];
}

std::optional<double> Known(const DampingKey& key) {
  if (key.kind != DampingKey::Kind::kNumber) return std::nullopt;
  return key.value;
}

}  // namespace

std::string UnitOf(const std::string& name) {
  static const std::map<std::string, std::string> units = {{"length", "m"},
                                                           {"diameter", "m"},
                                                           {"mass_per_length", "kg/m"},
                                                           {"EI", "N m^2"},
                                                           {"EI1", "N m^2"},
                                                           {"EI2", "N m^2"},
                                                           {"GJ", "N m^2"},
                                                           {"EA", "N"},
                                                           {"GA", "N"},
                                                           {"GA1", "N"},
                                                           {"GA2", "N"},
                                                           {"eta_EI", "N m^2 s"},
                                                           {"eta_EI1", "N m^2 s"},
                                                           {"eta_EI2", "N m^2 s"},
                                                           {"eta_GJ", "N m^2 s"},
                                                           {"eta_EA", "N s"},
                                                           {"eta_GA", "N s"},
                                                           {"eta_GA1", "N s"},
                                                           {"eta_GA2", "N s"},
                                                           {kEndDamping, "N m s"},
                                                           {"disc.inertia", "kg m^2"}};
  const auto found = units.find(name);
  return found == units.end() ? ExtensionNumberUnit(name) : found->second;
}

bool IsDamping(const std::string& name) {
  return name.rfind("eta_", 0) == 0 || name == kEndDamping ||
         name.rfind("extensions.clamp_damping", 0) == 0;
}

std::optional<double> NumberOf(const std::string& name, const CableKeys& keys) {
  CableKeys copy = keys;
  if (name == kEndDamping) {
    const double* value = Dashpot(&copy, false);
    return value ? std::optional<double>(*value) : std::nullopt;
  }
  if (const auto* key = Single(name, &copy)) return key->value;
  if (const auto* key = SingleDamping(name, &copy))
    return key->value ? Known(*key->value) : std::nullopt;
  if (const auto pair = StiffnessPair(name, &copy); pair.key)
    return pair.key->value ? std::optional<double>((*pair.key->value)[std::max(0, pair.which)])
                           : std::nullopt;
  if (const auto pair = DampingInPair(name, &copy); pair.key)
    return pair.key->value ? Known((*pair.key->value)[std::max(0, pair.which)]) : std::nullopt;
  const std::vector<double*> numbers = ExtensionNumbers(name, &copy);
  return numbers.empty() ? std::nullopt : std::optional<double>(*numbers.front());
}

bool Gives(const std::string& name, const CableKeys& keys) {
  CableKeys copy = keys;
  if (name == kEndDamping) return Dashpot(&copy, false) != nullptr;
  if (const auto* key = Single(name, &copy)) return key->given();
  if (const auto* key = SingleDamping(name, &copy)) return key->given();
  if (const auto pair = StiffnessPair(name, &copy); pair.key) return pair.key->given();
  if (const auto pair = DampingInPair(name, &copy); pair.key) return pair.key->given();
  return !ExtensionNumbers(name, &copy).empty();
}

bool IsUnknown(const std::string& name, const CableKeys& keys) {
  constexpr auto kUnknown = DampingKey::Kind::kUnknown;
  CableKeys copy = keys;
  if (const auto* key = SingleDamping(name, &copy))
    return key->value && key->value->kind == kUnknown;
  if (const auto pair = DampingInPair(name, &copy); pair.key && pair.key->value)
    return (*pair.key->value)[std::max(0, pair.which)].kind == kUnknown;
  return false;
}

void SetNumber(const std::string& name, double value, CableKeys* keys) {
  if (name == kEndDamping) {
    *Dashpot(keys, true) = value;
  } else if (auto* key = Single(name, keys)) {
    key->value = value;
    Give(&key->mark, name);
  } else if (auto* key = SingleDamping(name, keys)) {
    key->value = DampingKey{DampingKey::Kind::kNumber, value};
    Give(&key->mark, name);
  } else if (const auto pair = StiffnessPair(name, keys); pair.key) {
    Pair& both = pair.key->value ? *pair.key->value : pair.key->value.emplace(Pair{value, value});
    if (pair.which >= 0)
      both[pair.which] = value;
    else
      both = {value, value * both[1] / both[0]};
    Give(&pair.key->mark, name);
  } else if (const auto pair = DampingInPair(name, keys); pair.key) {
    const DampingKey number{DampingKey::Kind::kNumber, value};
    DampingPair& both =
        pair.key->value ? *pair.key->value : pair.key->value.emplace(DampingPair{number, number});
    if (pair.which >= 0) {
      both[pair.which] = number;
    } else {
      const std::optional<double> first = Known(both[0]), second = Known(both[1]);
      const double ratio = first && second && *first > 0 ? *second / *first : 1.0;
      both = {number, {DampingKey::Kind::kNumber, value * ratio}};
    }
    Give(&pair.key->mark, name);
  } else {
    const std::vector<double*> numbers = ExtensionNumbers(name, keys);
    // The second direction goes with the first in proportion.
    if (numbers.size() == 2)
      *numbers[1] = *numbers[0] == 0 ? value : value * (*numbers[1] / *numbers[0]);
    if (!numbers.empty()) *numbers[0] = value;
  }
}

}  // namespace cosserat_cable
