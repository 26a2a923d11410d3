// Finds the triangle nearest to a point. The one place that knows FCL.
#pragma once

#include <memory>

#include "closest_point.h"
#include "cosserat_cable/contact/shape.h"

namespace cosserat_cable {

class TriangleTree {
 public:
  /// @pre triangles have area; at least one.
  explicit TriangleTree(const TriangleMesh& mesh);
  ~TriangleTree();
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;

  struct Hit {
    int triangle = -1;  ///< -1: none nearer than the bound
    double distance_squared = 0;
    ClosestPoint closest;
  };
  /// Allocates nothing; safe from several threads at once. @pre p finite
  Hit Nearest(const Eigen::Vector3d& p, double bound) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosserat_cable
