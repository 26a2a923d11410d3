// What was fitted on a specimen, for another cable of the same kind: in a rig, or in a vehicle.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// Reads the keys of the single cable (`cable:`) of a cable file, before defaults.
CableKeys LoadSpecimenFile(const std::string& path, Problems* problems);

/// The keys of a cable with what can be fitted, stiffness, damping and extensions, from a
/// specimen's file where that gives it. Length, outline and masses stay the cable's own.
CableKeys WithFitted(const CableKeys& cable, const CableKeys& specimen);

/// The specimens whose section cables of a vehicle's file have.
class SectionFiles {
 public:
  SectionFiles() = default;
  /// Each "FILE", for all cables, or "NAME=FILE" for one of them. What is wrong goes to `problems`.
  SectionFiles(const std::vector<std::string>& texts, Problems* problems);

  /// Gives a cable the section that is meant for it: its own NAME before the one for all. A section
  /// of another outline is a problem.
  void Apply(const std::string& name, CableKeys* keys, Problems* problems);
  /// NAMEs that no cable had.
  void ReportUnused(const std::vector<std::string>& cables, Problems* problems) const;

 private:
  struct Section {
    std::string text, cable, path;
    CableKeys keys;
    bool used = false;
  };
  std::vector<Section> sections_;
};

}  // namespace cosserat_cable
