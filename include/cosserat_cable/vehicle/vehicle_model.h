// A vehicle as its URDF says it: links with collision geometry, joints, and the pose across a joint.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "cosserat_cable/contact/shape.h"
#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

struct JointModel {
  enum class Type { kFixed, kRevolute, kPrismatic, kFloating };  ///< continuous counts as revolute
  std::string name, parent, child;
  Type type = Type::kFixed;
  Pose X_PJ;                                          ///< of the child at position zero, in the parent
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();    ///< unit, in the joint's frame
  std::string mimic;                                  ///< joint that it follows, or empty
  double mimic_multiplier = 1, mimic_offset = 0;

  /// Pose of the child in the parent at a position [rad] or [m].
  Pose Evaluate(double position) const;
};

/// Turns "package://NAME" into a folder; returns "" for an unknown package.
using PackageFinder = std::function<std::string(const std::string& package)>;

/// Looks for a folder with the package's package.xml upwards from `start`, then in $ROS_PACKAGE_PATH.
PackageFinder FindPackagesFrom(const std::string& start);

struct VehicleModel {
  std::string name;
  std::string root;                               ///< the root link
  std::vector<std::string> links;                 ///< in the file's order
  std::vector<JointModel> joints;
  std::map<std::string, std::vector<Shape>> collision;  ///< by link; only links named in `wanted`

  const JointModel* FindJoint(const std::string& name) const;
  bool HasLink(const std::string& name) const;
};

/// Reads a URDF file. Collision meshes are loaded for the links in `collision_links` only (unknown names are ignored here:
/// the caller knows where they were written). Every mistake goes to `problems` with file and line: malformed XML,
/// more than one root, a mesh that is missing or has NaN vertices, a package that cannot be found.
VehicleModel LoadVehicle(const std::string& path, const std::vector<std::string>& collision_links,
                         const PackageFinder& find_package, Problems* problems);

}  // namespace cosserat_cable
