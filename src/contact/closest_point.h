// The point of a triangle that is nearest to a given point, and the feature on which it lies.
#pragma once

#include <Eigen/Core>

namespace cosserat_cable {

/// Face, edge i (from corner i to corner i + 1 mod 3), or corner i.
enum class Feature { kFace, kEdge0, kEdge1, kEdge2, kCorner0, kCorner1, kCorner2 };

struct ClosestPoint {
  Eigen::Vector3d point;
  Feature feature;
};

/// Exact up to rounding for any triangle of non-zero area (Voronoi regions as in Ericson, Real-Time
/// Collision Detection, 5.1.5). A point within 1e-12 of an edge or corner, relative to the
/// triangle, counts as on it.
ClosestPoint ClosestOnTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                               const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace cosserat_cable
