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
  /// The cylinder's, where that is smaller than the box; else -1.
  int axis() const { return turns_ ? axis_ : -1; }
  /// Not more than the distance from `p` [m] to the solid; above zero only outside of it.
  double Distance(const Eigen::Vector3d& p) const;
  /// Such a bound for all points at once, which holds however they turn about axis(), where there is
  /// one.
  double DistanceTurned(const PointRows& points) const;

 private:
  Eigen::AlignedBox3d box_;
  int axis_ = 2;
  bool turns_ = false;
  double inner_ = 0, outer_ = 0;  // radii [m]
};

}  // namespace cosserat_cable
