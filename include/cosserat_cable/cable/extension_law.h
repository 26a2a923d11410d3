// What a law that a cable may have beside the rigidly clamped Kelvin-Voigt rod tells of itself.
// Reading, writing, its numbers in the registry of parameters, and reporting mistakes follow from
// its keys. The laws stand in the room `causes`.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/input/number_spec.h"
#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable {

/// One key of an extension.
struct ExtensionField {
  enum class Need {
    kRequired,
    kAny,      ///< may be left out; an entry without any of these would do nothing: a mistake
    kInGroup,  ///< required where its map of the entry is given; so is one such map at least
    kOptional  ///< may be left out
  };
  std::string path;  ///< "tau"; "a.bending" for one in a map of the entry
  std::string unit;
  NumberSpec spec;
  Need need = Need::kRequired;
  std::optional<double> otherwise =
      std::nullopt;   ///< where it is left out; nothing: then it is absent
  bool pair = false;  ///< one key for both directions (EI) or two (EI1, EI2)
  /// Where the whole entry has no effect; nothing: nowhere, or it takes other numbers too.
  std::optional<double> neutral = std::nullopt;
};

struct ExtensionLaw {
  std::string name;
  std::string shape;       ///< what is said to be expected of an entry (of a list's item)
  bool list = false;       ///< one or more of the same
  bool of_record = false;  ///< acts over a record's time: a measurement set only
  std::vector<ExtensionField> fields;
  /// Reports what does not go with the rest of the cable; may be null.
  void (*check)(const ExtensionKey& key, const CableKeys& cable, Problems* problems) = nullptr;
  /// Changes the rod of a cable with this extension, with all amplitudes at zero nothing; may be
  /// null.
  void (*enter)(const CableExtension& extension, rod::RodModel* rod) = nullptr;
  /// What acts on the rod from outside, null for nothing; may itself be null.
  std::shared_ptr<const rod::Load> (*load)(const CableExtension& extension,
                                           const CableModel& cable) = nullptr;
  /// Of an obstacle: how deep the cable's surface is in it where its centreline is at `p_A`, in
  /// clamp a's frame [m]; negative: clear of it. May be null.
  double (*depth)(const CableExtension& extension, const CableModel& cable,
                  const Eigen::Vector3d& p_A) = nullptr;
};

/// Every one that there is, by name. They are read, written and entered in this order.
const std::vector<ExtensionLaw>& ExtensionLaws();
/// @throws std::invalid_argument for an extension that there is not
const ExtensionLaw& LawOf(const CableExtension& extension);
/// The paths of a field's numbers: two of a pair.
std::vector<std::string> NumberPaths(const ExtensionField& field);

}  // namespace cosserat_cable
