// One piece of a body's boundary, in the body's frame.
#pragma once

#include <memory>

#include "cosserat_cable/contact/body.h"

namespace cosserat_cable {

class Surface {
 public:
  virtual ~Surface() = default;
  /// Replaces `best` if this surface is nearer to `p_B` (in the signed sense) and nearer than
  /// `reach` [m].
  virtual void Improve(const Eigen::Vector3d& p_B, double reach, Clearance* best) const = 0;
  /// Holds the surface, so that a point outside of the box is outside of the shape.
  const Eigen::AlignedBox3d& box() const { return box_; }

 protected:
  Eigen::AlignedBox3d box_;
};

}  // namespace cosserat_cable
