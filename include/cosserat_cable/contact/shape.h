// Collision geometry of one link, as read from the URDF: primitives and meshes in the link's frame.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

struct Sphere {
  double radius;
};  // [m]
struct Box {
  Eigen::Vector3d size;
};  // full edge lengths [m]
struct Cylinder {
  double radius;
  double length;
};  // axis z, centred [m]
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;   // [m]
  std::vector<Eigen::Vector3i> triangles;  // counter-clockwise from outside
};

/// A shape at its pose in the link's frame.
struct Shape {
  Pose X_LS;
  std::variant<Sphere, Box, Cylinder, TriangleMesh> geometry;
};

/// Reads an STL (binary or ASCII), DAE or OBJ file through assimp, as rviz shows it: all its meshes
/// merged with their node transforms and DAE's unit applied, DAE's up_axis not, then `scale`
/// (without unit, may mirror). Vertices that agree in single precision are welded, triangles of
/// zero area dropped. Adds to `problems`, under the name of the file, and returns an empty mesh
/// where the file is missing, unreadable, without any triangle, or has a vertex that is not finite,
/// or where `scale` is zero or not finite.
TriangleMesh LoadMesh(const std::string& path, const Eigen::Vector3d& scale, Problems* problems);

}  // namespace cosserat_cable
