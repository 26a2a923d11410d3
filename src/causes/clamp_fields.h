// What extensions of the clamps share: numbers for bending and torsion at clamps a and b.
#pragma once

#include "cosserat_cable/cable/extension_law.h"

namespace cosserat_cable {

/// `a` and `b`, each with `bending` and `torsion`.
inline std::vector<ExtensionField> ClampFields(const NumberSpec& spec, const std::string& unit) {
  std::vector<ExtensionField> fields;
  for (const char* path : {"a.bending", "a.torsion", "b.bending", "b.torsion"})
    fields.push_back({path, unit, spec, ExtensionField::Need::kAny});
  return fields;
}

/// Calls `act(end, axis, value)` for each axis of the clamps about which a number is given.
template <class Act>
void ForEachClampAxis(const CableExtension& extension, rod::RodModel* rod, const Act& act) {
  const auto& numbers = extension.parts.front();
  for (const auto& [clamp, end] : {std::make_pair(std::string("a"), &rod->a), {"b", &rod->b}}) {
    if (const auto bending = numbers.find(clamp + ".bending"); bending != numbers.end())
      for (const int axis : {0, 1}) act(end, axis, bending->second);
    if (const auto torsion = numbers.find(clamp + ".torsion"); torsion != numbers.end())
      act(end, 2, torsion->second);
  }
}

/// The numbers of one clamp, by their names in its map.
class ClampNumbers {
 public:
  ClampNumbers(const std::map<std::string, double>& numbers, std::string clamp)
      : numbers_(numbers), clamp_(std::move(clamp)) {}
  double operator()(const std::string& name) const { return numbers_.at(clamp_ + "." + name); }

 private:
  const std::map<std::string, double>& numbers_;
  std::string clamp_;
};

/// Calls `act(end, numbers)` for each of these maps that is given.
template <class Act>
void ForEachGroup(const CableExtension& extension,
                  const std::vector<std::pair<std::string, rod::EndModel*>>& groups,
                  const Act& act) {
  const auto& numbers = extension.parts.front();
  for (const auto& [group, end] : groups) {
    const auto first = numbers.lower_bound(group + ".");
    if (first != numbers.end() && first->first.rfind(group + ".", 0) == 0)
      act(end, ClampNumbers(numbers, group));
  }
}

/// For the maps `a` and `b`.
template <class Act>
void ForEachClamp(const CableExtension& extension, rod::RodModel* rod, const Act& act) {
  ForEachGroup(extension, {{"a", &rod->a}, {"b", &rod->b}}, act);
}

}  // namespace cosserat_cable
