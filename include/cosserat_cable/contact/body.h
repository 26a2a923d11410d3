// A body that cables may touch, and the one query asked of it: how far is this point from it?
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "cosserat_cable/contact/point_rows.h"
#include "cosserat_cable/contact/shape.h"

namespace cosserat_cable {

/// Where a body is nearest to a point, all in the body's frame B.
struct Clearance {
  double distance =
      std::numeric_limits<double>::infinity();        ///< [m]; negative inside a closed shape
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();  ///< on the surface [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, out of the body at `nearest`
  int shape = -1;  ///< index of the shape; -1: none within reach, and all else here says nothing
  bool two_sided = false;  ///< an open mesh: `distance` >= 0, the normal points to the query's side
  bool rim = false;        ///< `nearest` is on the border of an open mesh, where its sides meet
};

/// Lets bodies share what they make of equal meshes: a vehicle has four wheels, and one mesh of
/// them. Needed while bodies are made, which may be in several threads at once, and not after.
class MeshStore {
 public:
  MeshStore();
  ~MeshStore();

 private:
  friend class Body;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The shapes of one link. Immutable and safe to query from several threads at once.
///
/// A mesh counts as closed where its triangles, connected over edges, share each edge by just two
/// in opposite directions; a mesh's closed parts are bodies of their own (facing outward, whichever
/// way the file has them: a cavity counts as solid), everything else is a two-sided shell.
class Body {
 public:
  /// `store`: meshes are looked up there first; null: this body shares none.
  /// @pre shapes are valid (LoadMesh reported no problem; sizes positive)
  /// @throws std::invalid_argument where they are not
  explicit Body(const std::vector<Shape>& shapes, MeshStore* store = nullptr);
  ~Body();
  Body(Body&&) noexcept;
  Body& operator=(Body&&) noexcept;

  /// The smallest signed distance over all shapes from a point `p_B` [m]. Shapes farther than
  /// `reach` [m]
  /// (> 0, may be infinite) are pruned; where all are, the result has infinite distance (and any
  /// true distance is >= reach). So it has where `p_B` is not finite. Inside a closed shape the
  /// answer is exact, however deep. Allocates nothing.
  Clearance Query(const Eigen::Vector3d& p_B, double reach) const;

  /// A bound from simple solids around the shapes alone [m]: the signed distance is no less. -inf
  /// within one.
  double LowerBound(const Eigen::Vector3d& p_B) const;
  /// An axis of B (0, 1 or 2) about which the body turns without taking up more room, as a wheel;
  /// -1: none.
  int axis() const;
  /// Such a bound for all `points_B` at once, which holds however they turn about axis().
  double LowerBoundTurned(const PointRows& points_B) const;

  /// Axis-aligned box that holds all shapes, in B. Empty where there are none.
  const Eigen::AlignedBox3d& bounds() const;
  /// Triangles in use, after cleaning.
  int triangle_count() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosserat_cable
