// Collision geometry of one link: urdfdom's shapes, with their meshes loaded.
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

/// The shapes of `link`, which is written in `element` of the file `path`. Mesh names: package://,
/// file://, absolute, or relative to the file.
std::vector<Shape> LoadCollision(const urdf::Link& link, const tinyxml2::XMLElement& element,
                                 const std::string& path, const PackageFinder& find_package,
                                 MeshCache* cache, Problems* problems);

}  // namespace cosserat_cable
