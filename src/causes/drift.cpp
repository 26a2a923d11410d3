// `drift`: stiffness and damping that change over the time of a record.
#include "cosserat_cable/causes/drift.h"

#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {
namespace {

constexpr const char* kName = "drift";

// What is left is a stiffness; a damping may come to nothing.
NumberSpec StiffnessChangeSpec() { return NumberSpec::Above(-1, "").AtMost(100); }
NumberSpec DampingChangeSpec() { return NumberSpec::AtLeast(-1, "").AtMost(100); }

// At a record's first instant the cable is what its keys say.
void Enter(const CableExtension&, rod::RodModel*) {}

}  // namespace

std::optional<Drift> DriftOf(const CableModel& cable) {
  for (const CableExtension& extension : cable.extensions) {
    if (extension.name != kName) continue;
    const auto& numbers = extension.parts.front();
    return Drift{numbers.at("EI"), numbers.at("eta_EI"), numbers.at("GJ"), numbers.at("eta_GJ")};
  }
  return std::nullopt;
}

rod::Section Drifted(const rod::Section& section, const Drift& drift, double part) {
  rod::Section now = section;
  now.C_M.head<2>() *= 1 + drift.EI * part;
  now.C_M.z() *= 1 + drift.GJ * part;
  now.V_M.head<2>() *= 1 + drift.eta_EI * part;
  now.V_M.z() *= 1 + drift.eta_GJ * part;
  return now;
}

Cause DriftCause() {
  using Need = ExtensionField::Need;
  Cause cause;
  ExtensionLaw& law = cause.law.emplace();
  law.name = kName;
  law.shape = "relative changes {EI: ..., eta_EI: ..., GJ: ..., eta_GJ: ...}";
  law.of_record = true;
  for (const char* path : {"EI", "GJ"})
    law.fields.push_back({path, "", StiffnessChangeSpec(), Need::kAny, 0.0, false, 0.0});
  for (const char* path : {"eta_EI", "eta_GJ"})
    law.fields.push_back({path, "", DampingChangeSpec(), Need::kAny, 0.0, false, 0.0});
  law.enter = Enter;
  cause.name = law.name;
  cause.words = "parameters that change over the time of a record";
  cause.hypotheses = {{{{{"extensions.drift.EI"}},
                        {{"extensions.drift.eta_EI"}},
                        {{"extensions.drift.GJ"}},
                        {{"extensions.drift.eta_GJ"}}}}};
  return cause;
}

}  // namespace cosserat_cable
