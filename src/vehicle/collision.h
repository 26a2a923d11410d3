// Geometry of one link: urdfdom's shapes, with their meshes loaded.
#pragma once

#include <tinyxml2.h>
#include <urdf_model/link.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/contact/shape.h"
#include "cosserat_cable/vehicle/package_finder.h"

namespace cosserat_cable {

/// The pose of urdfdom's type.
Pose ToPose(const urdf::Pose& pose);

/// Meshes loaded so far without a problem, by file name as written and scale: most vehicles show
/// one mesh at each of their corners.
using MeshCache = std::map<std::pair<std::string, std::array<double, 3>>, TriangleMesh>;

enum class GeometryKind { kCollision, kVisual };

/// The name of the XML element: "collision" or "visual".
const char* ElementName(GeometryKind kind);

/// All files that the URDF at `path` means by the names of its meshes, used or not, that can be
/// found.
std::vector<std::string> MeshFiles(const tinyxml2::XMLElement& robot, const std::string& path,
                                   const PackageFinder& find_package);

/// The shapes of `link`, which is written in `element` of the file `path`, but for those with a
/// size of zero. Mesh names: package://, file://, absolute, or relative to the file.
std::vector<Shape> LoadGeometry(const urdf::Link& link, GeometryKind kind,
                                const tinyxml2::XMLElement& element, const std::string& path,
                                const PackageFinder& find_package, MeshCache* cache,
                                Problems* problems);

}  // namespace cosserat_cable
