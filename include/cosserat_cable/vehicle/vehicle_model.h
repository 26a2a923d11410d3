// A vehicle as its URDF says it: links with collision geometry, joints, and the pose across a
// joint.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/contact/shape.h"
#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/vehicle/package_finder.h"

namespace cosserat_cable {

struct JointModel {
  /// Continuous counts as revolute; planar as floating: no one number says where it is.
  enum class Type { kFixed, kRevolute, kPrismatic, kFloating };
  std::string name, parent, child;
  Type type = Type::kFixed;
  Pose X_PJ;  ///< of the child at position zero, in the parent
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit, in the joint's frame

  /// The joint whose position this one's follows, as multiplier * position + offset; or empty. That
  /// joint follows none itself: LoadVehicle resolves chains.
  std::string mimic;
  double mimic_multiplier = 1, mimic_offset = 0;

  /// Limits of the position [rad] or [m] and of its rate [/s]; infinite where there are none.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double velocity = std::numeric_limits<double>::infinity();

  /// Pose of the child in the parent at a position [rad] or [m]. Fixed and floating joints have
  /// none: X_PJ whatever it is.
  Pose Evaluate(double position) const;
};

/// What a link's entry in the URDF has to touch.
struct LinkEntry {
  int line = 0;
  int collisions = 0, visuals = 0;  ///< elements, also such without extent
};

struct VehicleModel {
  std::string name;
  std::string root;                          ///< the root link
  std::vector<std::string> links;            ///< in the file's order
  std::vector<JointModel> joints;            ///< in the file's order
  std::map<std::string, LinkEntry> entries;  ///< by link
  /// By link; only those of `collision_links` that have collision geometry with an extent.
  std::map<std::string, std::vector<Shape>> collision;
  std::map<std::string, std::vector<Shape>> visual;  ///< likewise, of VehicleUse::visual_links
  /// That the URDF names, used or not.
  std::vector<std::string> mesh_files;
  Problems warnings;  ///< what contradicts itself, and is taken by urdfdom all the same
  Problems notes;     ///< what is worth knowing, and stops nothing

  const JointModel* FindJoint(const std::string& name) const;  ///< null where there is none
  bool HasLink(const std::string& name) const;
};

/// What cables use of a vehicle besides its collision geometry.
struct VehicleUse {
  std::vector<std::string> visual_links;  ///< whose visual geometry they may touch
  /// Whose motion they follow; the joints above these are judged, others only as far as urdfdom
  /// does. Nothing: all.
  std::optional<std::vector<std::string>> moving_links;
};

/// Reads a URDF file. Collision meshes are loaded for the links in `collision_links` only (unknown
/// names are ignored here: the caller knows where they were written). Every mistake goes to
/// `problems` with file and line: malformed XML, an unknown joint type, a
/// number that is none, a zero axis, links that do not form one tree; of geometry that is used a
/// negative size, a mesh that is missing or has NaN vertices, a package that cannot be found. A
/// size of zero is noted where it is used. After a mistake other than in a mesh the vehicle holds
/// its links' names and entries alone.
VehicleModel LoadVehicle(const std::string& path, const std::vector<std::string>& collision_links,
                         const PackageFinder& find_package, Problems* problems,
                         const VehicleUse& use = {});

}  // namespace cosserat_cable
