#include "collision.h"

#include <filesystem>
#include <set>

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

bool HasZero(const urdf::Vector3& v) { return v.x == 0 || v.y == 0 || v.z == 0; }

/// A size of zero: there is nothing to touch.
bool IsEmpty(const urdf::Geometry& geometry) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      return static_cast<const urdf::Sphere&>(geometry).radius == 0;
    case urdf::Geometry::BOX:
      return HasZero(static_cast<const urdf::Box&>(geometry).dim);
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      return cylinder.radius == 0 || cylinder.length == 0;
    }
    case urdf::Geometry::MESH:
      return HasZero(static_cast<const urdf::Mesh&>(geometry).scale);
  }
  return false;
}

decltype(Shape::geometry) ToShape(const urdf::Geometry& geometry,
                                  const tinyxml2::XMLElement& element, const std::string& path,
                                  const PackageFinder& find_package, MeshCache* cache,
                                  Problems* problems) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      return Sphere{static_cast<const urdf::Sphere&>(geometry).radius};
    case urdf::Geometry::BOX: {
      const urdf::Vector3& size = static_cast<const urdf::Box&>(geometry).dim;
      return Box{{size.x, size.y, size.z}};
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      return Cylinder{cylinder.radius, cylinder.length};
    }
    case urdf::Geometry::MESH:
      break;
  }
  return LoadMeshNamed(static_cast<const urdf::Mesh&>(geometry), element, path, find_package, cache,
                       problems);
}

}  // namespace

Pose ToPose(const urdf::Pose& pose) {
  const urdf::Rotation& q = pose.rotation;
  return {{pose.position.x, pose.position.y, pose.position.z},
          Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized()};
}

const char* ElementName(GeometryKind kind) {
  return kind == GeometryKind::kCollision ? "collision" : "visual";
}

std::vector<std::string> MeshFiles(const tinyxml2::XMLElement& robot, const std::string& path,
                                   const PackageFinder& find_package) {
  std::set<std::string> names;
  for (const auto* link = robot.FirstChildElement("link"); link;
       link = link->NextSiblingElement("link"))
    for (const GeometryKind kind : {GeometryKind::kCollision, GeometryKind::kVisual})
      for (const auto* e = link->FirstChildElement(ElementName(kind)); e;
           e = e->NextSiblingElement(ElementName(kind))) {
        const auto* geometry = e->FirstChildElement("geometry");
        const auto* mesh = geometry ? geometry->FirstChildElement("mesh") : nullptr;
        if (const char* name = mesh ? mesh->Attribute("filename") : nullptr) names.insert(name);
      }
  // Looking for a package walks over folders: once for each.
  std::map<std::string, std::string> packages;
  const PackageFinder find = [&](const std::string& package) {
    const auto [known, is_new] = packages.try_emplace(package);
    if (is_new) known->second = find_package(package);
    return known->second;
  };
  std::vector<std::string> files;
  for (const std::string& name : names) {
    std::string error;
    const std::string file = ResolveMesh(name, path, find, &error);
    if (!file.empty()) files.push_back(file);
  }
  return files;
}

std::vector<Shape> LoadGeometry(const urdf::Link& link, GeometryKind kind,
                                const tinyxml2::XMLElement& element, const std::string& path,
                                const PackageFinder& find_package, MeshCache* cache,
                                Problems* problems) {
  std::vector<Shape> shapes;
  const tinyxml2::XMLElement* written = element.FirstChildElement(ElementName(kind));
  const auto add = [&](const urdf::Pose& origin, const urdf::Geometry& geometry) {
    if (!IsEmpty(geometry)) {
      const tinyxml2::XMLElement* shape =
          written->FirstChildElement("geometry")->FirstChildElement();
      shapes.push_back(
          {ToPose(origin), ToShape(geometry, *shape, path, find_package, cache, problems)});
    }
    written = written->NextSiblingElement(ElementName(kind));
  };
  if (kind == GeometryKind::kCollision) {
    for (const auto& collision : link.collision_array) add(collision->origin, *collision->geometry);
  } else {
    for (const auto& visual : link.visual_array) add(visual->origin, *visual->geometry);
  }
  return shapes;
}

}  // namespace cosserat_cable
