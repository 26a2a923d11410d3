// What cable_modes prints and writes.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/rod/modes.h"

namespace cosserat_cable {

struct CableModes {
  CableModel model;
  std::vector<Pose> rest;  ///< of the nodes, in the root link
  std::vector<rod::Mode> modes;
  double wall_time = 0;  ///< of the search for modes [s]
  bool touches = false;  ///< a body, at rest
  std::string warning;   ///< that it is too deep in it; else empty
  std::string failure;   ///< empty while all is well
};

/// A table for people.
std::string ModesText(const CableModes& cable);
/// Of all cables.
std::string ModesJson(const std::vector<CableModes>& cables, double wall_time);
/// A row per node: arc length, rest position, and each mode's displacement and rotation.
std::string ModesCsv(const CableModes& cable);

}  // namespace cosserat_cable
