// A simple solid around a piece of a body: how far a point is at least, at the cost of one root.
#pragma once

#include "cosserat_cable/contact/point_rows.h"
#include "cosserat_cable/contact/shape.h"

namespace cosserat_cable {

/// The axis-aligned box, and a hollow cylinder about one of the frame's axes, which fits what turns
/// about that axis far better: to a point beside a spinning wheel the box's corners come and go,
/// the cylinder stays.
class Envelope {
 public:
  /// Holds nothing.
  Envelope() = default;
  /// Around a solid of which only the box is known.
  explicit Envelope(const Eigen::AlignedBox3d& box);
  /// @pre at least one triangle
  explicit Envelope(const TriangleMesh& mesh);

  const Eigen::AlignedBox3d& box() const { return box_; }
  /// Not more than the distance from `p` [m] to the solid; above zero only outside of it.
  double Distance(const Eigen::Vector3d& p) const;
  /// True where all points are farther than `margin` >= 0 [m] from the solid by that bound.
  bool IsBeyond(double margin, const PointRows& points) const;

 private:
  Eigen::AlignedBox3d box_;
  int axis_ = 2;
  double inner_ = 0, outer_ = 0;  // radii [m]
};

}  // namespace cosserat_cable
