// What belongs together in a triangle mesh, and which way it faces.
#pragma once

#include <array>
#include <vector>

#include "closest_point.h"
#include "cosserat_cable/contact/shape.h"

namespace cosserat_cable {

/// Triangles with a normal for each face, edge and corner: the angle-weighted pseudonormals, whose
/// sign tells inside from outside wherever the nearest point lies (Baerentzen and Aanaes 2005, IEEE
/// TVCG 11(3)).
struct OrientedMesh {
  TriangleMesh mesh;
  bool closed = false;

  struct Face {
    Eigen::Vector3d normal;
    std::array<Eigen::Vector3d, 3> edge_normals;
    std::array<bool, 3> edge_is_rim;
  };
  std::vector<Face> faces;
  std::vector<Eigen::Vector3d> corner_normals;  ///< per vertex
  std::vector<bool> corner_is_rim;

  const Eigen::Vector3d& Normal(int triangle, Feature feature) const;
  /// On the border of an open mesh, where its two sides meet.
  bool IsRim(int triangle, Feature feature) const;
};

/// Splits a clean mesh into its closed parts, each facing outward, and one open part with all the
/// rest. Closed: connected over edges, each shared by just two triangles in opposite directions,
/// around a volume.
std::vector<OrientedMesh> SplitIntoParts(const TriangleMesh& mesh);

}  // namespace cosserat_cable
