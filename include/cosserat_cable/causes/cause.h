// A cause: something that the rigidly clamped Kelvin-Voigt rod in still air does not have, and that
// a real cable, its clamps, its surroundings or its record may have.
//
// A new one is a file src/causes/some_name.cpp with a function SomeNameCause(), which tells its
// law, if it is one of the cable, and where a diagnosis begins to look for it; its test; and its
// paragraph in config/cables/template.yaml. The build finds it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/cable/extension_law.h"

namespace cosserat_cable {

/// What a number of a hypothesis is a multiple of.
enum class NumberScale {
  kOne,               ///< its own unit
  kTypical,           ///< TypicalSize of its path
  kClampBending,      ///< EI/length [N m/rad]
  kClampTorsion,      ///< GJ/length [N m/rad]
  kSimplerStiffness,  ///< that the simpler cause has found for the same clamp and axis [N m/rad]
  kSimplerDashpot,    ///< that, over the angular frequency of the slowest swing [N m s/rad]
  kSimplerAngle,      ///< by which a clamp of that stiffness turns at most [rad]
  kClampDashpot,      ///< EI/length over the angular frequency of the slowest swing [N m s/rad]
  kCurvature,         ///< the largest change of curvature in the records [1/m]
  kClampMoment,       ///< the largest change of the bending moment at a clamp [N m]
  kTwistMoment,       ///< the largest change of the twisting moment at clamp a [N m]
  kPeriod,            ///< of the slowest swing [s]
  kFrequency,         ///< of the slowest swing [Hz]
  kLength             ///< the cable's [m]
};

/// One number of a hypothesis and where a fit starts with it.
struct HypothesisNumber {
  enum class Role {
    kSize,     ///< how much of it there is: starts faint, at its neutral value and a little more
    kInverse,  ///< how little of it there is: starts at so large a value that it hardly shows
    kFree,     ///< of another kind than a size (a threshold, a time, a place): starts at its value
    kBeside,   ///< the same, and acts by itself too: what sizes show is what they add to it
    kHeld      ///< stays at its value
  };
  std::string path;  ///< in the registry of parameters
  Role role = Role::kSize;
  double times = 1;
  NumberScale scale = NumberScale::kTypical;
  /// Where a size begins to act whose number has no neutral value: an obstacle's place.
  double origin = 0;
};

/// One way in which a cause may be at work.
struct Hypothesis {
  /// Each item is one component of it, numbers that grow from nothing together: what a record
  /// shows of a small one is found by one simulation. A fit frees the numbers of all components.
  std::vector<std::vector<HypothesisNumber>> components;
};

struct Cause {
  std::string name;
  std::string words;                ///< what is said of it to a user: "the clamp gives way"
  std::optional<ExtensionLaw> law;  ///< nothing: a fault of the record
  /// Alternatives; those that differ in the start of the same free numbers are one fit.
  std::vector<Hypothesis> hypotheses;
  /// The same, to be begun with where the simpler cause of `contains` has been fitted: thresholds
  /// and ratios that it has beside that one.
  std::vector<Hypothesis> from_simpler;
  /// Factors and angles, from their neutral values, that no such fault falls below: a smaller one
  /// that shows stands for something else. A tilt of a micro-radian about a far origin is a
  /// displacement.
  double least = 0;
  /// Cables of this kind have laws that differ in form, and their numbers with it: half of a 95 %
  /// interval on that account, in parts of each number.
  double form = 0;
  /// Records may show it by its square only: a faint one promises nothing of what a larger one
  /// does.
  bool acts_by_square = false;
  /// Simpler causes that it turns into where some of its numbers vanish or grow without bound.
  std::vector<std::string> contains;
};

/// All, by name.
const std::vector<Cause>& Causes();
/// Null where there is none of this name.
const Cause* FindCause(const std::string& name);

}  // namespace cosserat_cable
