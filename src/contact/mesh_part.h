// One part of a mesh, ready for queries in the mesh's own frame S.
#pragma once

#include "cosserat_cable/contact/body.h"
#include "mesh_topology.h"
#include "triangle_tree.h"

namespace cosserat_cable {

/// Immutable, so that the bodies of several links may share it.
class MeshPart {
 public:
  explicit MeshPart(OrientedMesh part);

  const TriangleMesh& mesh() const { return part_.mesh; }
  /// Where the part is nearest to `p_S`, in S; without a shape's index. Infinite distance where it
  /// is not nearer than `reach` and `best` [m].
  Clearance Nearest(const Eigen::Vector3d& p_S, double reach, double best) const;

 private:
  Clearance Resolve(const Eigen::Vector3d& p_S, const TriangleTree::Hit& hit) const;

  OrientedMesh part_;
  TriangleTree tree_;
  Eigen::AlignedBox3d box_;
  double noise_;  // [m]
};

}  // namespace cosserat_cable
