#include "collision.h"

#include <filesystem>

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;

bool StartsWith(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

/// The file that a URDF at `path` means by `name`; "" with a message in `error`.
std::string ResolveMesh(const std::string& name, const std::string& path,
                        const PackageFinder& find_package, std::string* error) {
  const std::string kPackage = "package://", kFile = "file://";
  if (StartsWith(name, kPackage)) {
    const std::size_t slash = name.find('/', kPackage.size());
    const std::string package = name.substr(kPackage.size(), slash - kPackage.size());
    const std::string folder = slash == std::string::npos ? "" : find_package(package);
    if (folder.empty()) {
      *error =
          "package '" + package + "' was not found above the URDF file nor in ROS_PACKAGE_PATH";
      return "";
    }
    return folder + name.substr(slash);
  }
  if (StartsWith(name, kFile)) return name.substr(kFile.size());
  if (name.find("://") != std::string::npos) {
    *error = "got '" + name + "', expected package://, file:// or a path";
    return "";
  }
  // An absolute name replaces the folder.
  return (fs::path(path).parent_path() / name).string();
}

TriangleMesh LoadMeshNamed(const urdf::Mesh& mesh, const tinyxml2::XMLElement& element,
                           const std::string& path, const PackageFinder& find_package,
                           MeshCache* cache, Problems* problems) {
  const MeshCache::key_type written = {mesh.filename, {mesh.scale.x, mesh.scale.y, mesh.scale.z}};
  const auto known = cache->find(written);
  if (known != cache->end()) return known->second;
  const std::string key = "mesh.filename";
  std::string error;
  const std::string file = ResolveMesh(mesh.filename, path, find_package, &error);
  if (file.empty()) {
    problems->Add(path, element.GetLineNum(), key, error);
    return {};
  }
  // The user looks for the line of the URDF; what is wrong is said of the mesh file.
  Problems found;
  TriangleMesh loaded = LoadMesh(file, {mesh.scale.x, mesh.scale.y, mesh.scale.z}, &found);
  for (const Problem& problem : found.all()) {
    problems->Add(path, element.GetLineNum(), key, problem.file + ": " + problem.message);
  }
  if (found.empty()) cache->emplace(written, loaded);
  return loaded;
}

}  // namespace

Pose ToPose(const urdf::Pose& pose) {
  const urdf::Rotation& q = pose.rotation;
  return {{pose.position.x, pose.position.y, pose.position.z},
          Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized()};
}

std::vector<Shape> LoadCollision(const urdf::Link& link, const tinyxml2::XMLElement& element,
                                 const std::string& path, const PackageFinder& find_package,
                                 MeshCache* cache, Problems* problems) {
  std::vector<Shape> shapes;
  const tinyxml2::XMLElement* written = element.FirstChildElement("collision");
  for (const urdf::CollisionSharedPtr& collision : link.collision_array) {
    Shape shape;
    shape.X_LS = ToPose(collision->origin);
    const urdf::Geometry& geometry = *collision->geometry;
    switch (geometry.type) {
      case urdf::Geometry::SPHERE:
        shape.geometry = Sphere{static_cast<const urdf::Sphere&>(geometry).radius};
        break;
      case urdf::Geometry::BOX: {
        const urdf::Vector3& size = static_cast<const urdf::Box&>(geometry).dim;
        shape.geometry = Box{{size.x, size.y, size.z}};
        break;
      }
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
        shape.geometry = Cylinder{cylinder.radius, cylinder.length};
        break;
      }
      case urdf::Geometry::MESH:
        shape.geometry =
            LoadMeshNamed(static_cast<const urdf::Mesh&>(geometry),
                          *written->FirstChildElement("geometry")->FirstChildElement("mesh"), path,
                          find_package, cache, problems);
        break;
    }
    shapes.push_back(std::move(shape));
    written = written->NextSiblingElement("collision");
  }
  return shapes;
}

}  // namespace cosserat_cable
