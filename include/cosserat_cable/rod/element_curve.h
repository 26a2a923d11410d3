// The centreline between two nodes of a rod.
#pragma once

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable::rod {

/// The curve from node to node of an element: the helix that leads from one pose to the other, as
/// the element's strains have it, and beyond it the cubic that turns the tangents to where the
/// sections have them. Exact where the strains are constant, as in a circle; else off by h^4/384
/// times the second derivative of the curvature.
class ElementCurve {
 public:
  /// Tangents are the sections' normals: of a section that does not shear.
  /// @param first, second poses of the nodes in any frame, turned against each other by less than
  /// pi
  ElementCurve(const Pose& first, const Pose& second);

  /// Of an element of a rod, whose tangents are inclined to the normals by the section's shear.
  ElementCurve(const Rod& rod, int element);

  /// Position and section rotation at the part `t` in [0, 1] of the arc length from the first.
  Pose At(double t) const;

 private:
  ElementCurve(const Pose& first, const Pose& second, const Eigen::Vector2d& sheared);

  Pose first_;
  Eigen::Vector3d theta_;   // of the second node against the first [rad]
  Eigen::Vector3d helix_;   // the helix's tangent in the sections' axes, its length the arc's [m]
  Eigen::Vector3d beyond_;  // what the tangent is more than that, at the first node
  Eigen::Vector3d beyond_second_;  // and at the second, in the axes of the first
};

}  // namespace cosserat_cable::rod
