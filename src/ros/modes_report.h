// What cable_modes prints and writes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/rod/modes.h"

namespace cosserat_cable {

struct CableModes {
  CableModel model;
  std::vector<Pose> rest;  ///< of the nodes, in ModesSetting::frame
  std::vector<rod::Mode> modes;
  double wall_time = 0;  ///< of the search for modes [s]
  bool touches = false;  ///< a body, at rest
  std::string warning;   ///< that it is too deep in it; else empty
  std::string failure;   ///< empty while all is well
};

/// Where the vehicle is, and what acts on all cables.
struct ModesSetting {
  std::string frame;  ///< of all coordinates: the vehicle's root, or the inertial frame
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< in it [m/s^2]
  std::map<std::string, double> joints;               ///< positions that are known [rad], [m]
  std::optional<double> time;  ///< of the recording, after its first sample [s]
  std::int64_t stamp = 0;      ///< the same [ns]
  std::vector<std::string> notes;
};

std::string SettingText(const ModesSetting& setting);
/// The same for the head of a YAML file.
std::string SettingComment(const ModesSetting& setting);

/// A table for people.
std::string ModesText(const CableModes& cable);
/// Of all cables.
std::string ModesJson(const std::vector<CableModes>& cables, const ModesSetting& setting,
                      double wall_time);
/// A row per node: arc length, rest position, and each mode's displacement and rotation.
std::string ModesCsv(const CableModes& cable);

}  // namespace cosserat_cable
