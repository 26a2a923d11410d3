// A body that cables may touch, and the one query asked of it: how far is this point from it?
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "cosserat_cable/contact/shape.h"

namespace cosserat_cable {

/// Where a body is nearest to a point, all in the body's frame B.
struct Clearance {
  double distance = std::numeric_limits<double>::infinity();  ///< [m]; negative inside a closed shape
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();          ///< on the surface [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();          ///< unit, out of the body at `nearest`
  int shape = -1;          ///< index of the shape
  bool two_sided = false;  ///< an open mesh: `distance` >= 0 and the normal points to the query's side
};

/// The shapes of one link. Immutable and safe to query from several threads at once.
class Body {
 public:
  /// @pre shapes are valid (LoadMesh reported no problem; sizes positive)
  explicit Body(const std::vector<Shape>& shapes);
  ~Body();
  Body(Body&&) noexcept;
  Body& operator=(Body&&) noexcept;

  /// Signed distance from a point `p_B` [m]. Shapes farther than `reach` [m] are pruned; where all are, the
  /// result has infinite distance (and any true distance is >= reach).
  Clearance Query(const Eigen::Vector3d& p_B, double reach) const;

  /// Axis-aligned box that holds all shapes, in B.
  const Eigen::AlignedBox3d& bounds() const;
  int triangle_count() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosserat_cable
