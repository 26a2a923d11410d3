// The numbers of a cable by their names, as `uncertain` gives them.
#pragma once

#include <optional>
#include <string>

#include "cosserat_cable/cable/cable_keys.h"

namespace cosserat_cable {

/// The dashpot at a disc, eqs. (12) and (13) of the source paper [N m s/rad].
inline constexpr const char* kEndDamping = "D_E";

/// "N m^2", ...
std::string UnitOf(const std::string& name);
bool IsDamping(const std::string& name);
/// Where the keys leave it open (`eta_EI: null`), or take a default: nothing. EI stands for EI1,
/// and EI2 goes with it in proportion.
std::optional<double> NumberOf(const std::string& name, const CableKeys& keys);
/// Whether these keys give it themselves, be it as unknown.
bool Gives(const std::string& name, const CableKeys& keys);
/// Whether the keys say that it is not known: null.
bool IsUnknown(const std::string& name, const CableKeys& keys);
/// Sets it. Pairs are scaled together by EI, GA, eta_EI and eta_GA.
void SetNumber(const std::string& name, double value, CableKeys* keys);

}  // namespace cosserat_cable
