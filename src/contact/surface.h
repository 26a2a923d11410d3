// One piece of a body's boundary, in the body's frame.
#pragma once

#include <memory>

#include "cosserat_cable/contact/body.h"
#include "envelope.h"

namespace cosserat_cable {

class Surface {
 public:
  virtual ~Surface() = default;
  /// Replaces `best` if this surface is nearer to `p_B` (in the signed sense) and nearer than
  /// `reach` [m].
  virtual void Improve(const Eigen::Vector3d& p_B, double reach, Clearance* best) const = 0;
  /// Holds the surface, so that a point outside of it is outside of the shape.
  const Envelope& envelope() const { return envelope_; }

 protected:
  Envelope envelope_;
};

}  // namespace cosserat_cable
