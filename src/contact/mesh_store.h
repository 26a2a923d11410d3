// Meshes made ready for queries, each once however many links show it.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <vector>

#include "cosserat_cable/contact/body.h"
#include "mesh_part.h"

namespace cosserat_cable {

using MeshParts = std::vector<std::shared_ptr<const MeshPart>>;

/// @throws std::invalid_argument where the mesh is not valid
MeshParts MakeMeshParts(const TriangleMesh& mesh);

struct MeshStore::Impl {
  /// The parts of a mesh with the same numbers, or new ones.
  const MeshParts& PartsOf(const TriangleMesh& mesh);

  struct Entry {
    explicit Entry(const TriangleMesh& m) : mesh(m) {}
    TriangleMesh mesh;
    std::once_flag made;
    MeshParts parts;
  };
  Entry& EntryOf(const TriangleMesh& mesh);

  std::mutex mutex;          // of the list
  std::list<Entry> entries;  // which stay where they are
};

}  // namespace cosserat_cable
