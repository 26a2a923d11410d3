#include "mesh_store.h"

#include <algorithm>
#include <stdexcept>

#include "mesh_cleanup.h"

namespace cosserat_cable {
namespace {

void RequireValid(const TriangleMesh& mesh) {
  for (const Eigen::Vector3d& v : mesh.vertices) {
    if (!v.allFinite()) throw std::invalid_argument("mesh has a vertex that is not finite");
  }
  const int count = static_cast<int>(mesh.vertices.size());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    if (t.minCoeff() < 0 || t.maxCoeff() >= count) {
      throw std::invalid_argument("mesh has a triangle with an index out of range");
    }
  }
}

}  // namespace

MeshParts MakeMeshParts(const TriangleMesh& mesh) {
  RequireValid(mesh);
  MeshParts parts;
  for (OrientedMesh& part : SplitIntoParts(CleanMesh(mesh)))
    parts.push_back(std::make_shared<MeshPart>(std::move(part)));
  return parts;
}

const MeshParts& MeshStore::Impl::PartsOf(const TriangleMesh& mesh) {
  Entry& entry = EntryOf(mesh);
  std::call_once(entry.made, [&] { entry.parts = MakeMeshParts(mesh); });
  return entry.parts;
}

MeshStore::Impl::Entry& MeshStore::Impl::EntryOf(const TriangleMesh& mesh) {
  const std::lock_guard<std::mutex> lock(mutex);
  const auto known = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) {
    return entry.mesh.vertices == mesh.vertices && entry.mesh.triangles == mesh.triangles;
  });
  return known != entries.end() ? *known : entries.emplace_back(mesh);
}

MeshStore::MeshStore() : impl_(std::make_unique<Impl>()) {}
MeshStore::~MeshStore() = default;

}  // namespace cosserat_cable
