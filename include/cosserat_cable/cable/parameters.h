// The one registry of what is a parameter: keys of a cable, numbers of its extensions, faults of a
// record. A parameter's name is its path in the file: "EI", "extensions.maxwell[0].EI",
// "faults.clock.scale". Reader, `uncertain`, fits and reports take names, units and ranges from
// here.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_keys.h"

namespace cosserat_cable {

/// The dashpot at a disc, D_E in eqs. (12) and (13) of the source paper [N m s/rad].
inline constexpr const char* kEndDamping = "extensions.clamp_damping.b.torsion";
/// Of the disc of an experiment, not of the cable's keys [kg m^2].
inline constexpr const char* kDiscInertia = "disc.inertia";

enum class ParameterSign { kPositive, kNonNegative, kSigned };

/// What is known of a parameter whatever the cable.
struct Parameter {
  std::string path;
  std::string unit;
  ParameterSign sign = ParameterSign::kPositive;
  /// The range that a file may give. A bound may belong to it or not.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  /// The value at which it has no effect, whatever else its entry says; it may be infinite.
  /// Nothing: there is none, a cable cannot do without it.
  std::optional<double> neutral;
  bool damping = false;  ///< a viscous loss: nothing at rest shows it
};

/// Whether the path is of a fault of a record; of that or of an extension, not of the cable itself.
bool IsFault(const std::string& path);
bool IsOfEntry(const std::string& path);

/// Nothing where neither a cable nor a record can have a parameter of this path. Of a list any
/// index is a path.
std::optional<Parameter> FindParameter(const std::string& path);
/// "N m^2"; "" where there is no such parameter.
std::string UnitOf(const std::string& path);

/// All that stand in these keys, and all that a cable always has: what a path that is not known is
/// compared with.
std::vector<std::string> ParameterPaths(const CableKeys& keys);

/// The same for faults: those that these keys have or could get.
std::vector<std::string> FaultPaths(const CableKeys& keys);
/// Whether SetParameter can set the fault of this path in these keys.
bool CanMakeFault(const std::string& path, const CableKeys& keys);

/// Its value: nothing where the keys leave it open (`eta_EI: null`) or do not have it. EI stands
/// for EI1, and EI2 goes with it in proportion.
std::optional<double> GetParameter(const std::string& path, const CableKeys& keys);
/// Whether these keys give it themselves, be it as unknown.
bool GivesParameter(const std::string& path, const CableKeys& keys);
/// Whether the keys say that it is not known: null.
bool IsUnknownParameter(const std::string& path, const CableKeys& keys);

/// Sets it. Pairs are scaled together by EI, GA, eta_EI and eta_GA. An entry that is not there is
/// made, and so is the next item of a list: what else it needs is at its default, or of its typical
/// size.
/// @throws std::invalid_argument for a path of no parameter of these keys
void SetParameter(const std::string& path, double value, CableKeys* keys);

/// A change of this size matters to a cable of this length, mass and stiffness: from its unit, by
/// the cable's own scales (its length, its first bending, a damping ratio of 0.05 there).
double TypicalSize(const std::string& path, const CableKeys& keys);

/// Angular frequency [rad/s] of the slowest bending, roughly: of a clamped-free cable.
double BendingFrequency(const CableKeys& keys);

/// Damping ratio that is ordinary for a cable.
inline constexpr double kTypicalDamping = 0.05;

}  // namespace cosserat_cable
