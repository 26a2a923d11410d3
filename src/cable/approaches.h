// How near a cable may have come to the bodies around it since it was last looked at.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "cosserat_cable/contact/body.h"

namespace cosserat_cable {

/// A bound of the whole cable's distance from each body, which shrinks by what the two move towards
/// each other at most. That costs a few operations for a body, however many elements and triangles
/// there are. How far a wheel turns about its axis does not count.
class Approaches {
 public:
  /// The bodies outlive this.
  explicit Approaches(const std::vector<const Body*>& bodies);

  /// Cable and bodies are there now. Ways are measured in a frame C: any is right, but one that
  /// goes along with the cable, as a clamp does, makes them short.
  void Move(const Pose& X_WC, const PointRows& nodes_W, const std::vector<Motion>& bodies_W);

  /// No point of the cable is nearer to the body [m]; -infinity: nothing is known.
  double at_least(std::size_t body) const { return bodies_[body].at_least; }
  /// Where the two are now, that is so; by bounds that hold however the body turns about its axis,
  /// where it has one.
  void Set(std::size_t body, double at_least) { bodies_[body].at_least = at_least; }

 private:
  struct Approached {
    const Body* body = nullptr;
    double at_least = -std::numeric_limits<double>::infinity();
    Pose X_CB;
  };
  std::vector<Approached> bodies_;
  PointRows nodes_C_, before_C_;
};

}  // namespace cosserat_cable
