// The arch as this package's rod, stepped as the peer is.
#pragma once

#include "swept_arch.h"

namespace cosserat_cable::bench {

struct RodSetting {
  int elements;  ///< even, so that the apex is a node
  double dt;     ///< [s]
};

class RodArch {
 public:
  RodArch(const SweptArch& arch, const RodSetting& setting)
      : rod_(Settled(arch.Model(setting.elements))), dt_(setting.dt) {}

  /// Gives the rod, which is at rest, the motion of the sweep's begin.
  bool Start() {
    Motion start;
    start.v.x() = SweptArch::StartVelocity();
    start.a.x() = SweptArch::StartAcceleration();
    rod_.AddRigidMotion(start);
    return true;
  }
  /// A step that ends with both clamps shifted along x [m]; false: it did not converge.
  bool Step(double shift) {
    return rod_.Step(dt_, SweptArch::ClampA(shift), SweptArch::ClampB(shift)).converged;
  }
  double Apex() const { return rod_.position(rod_.elements() / 2).x; }  ///< along x [m]
  double End() const { return rod_.position(0).x; }  ///< the cable's first end, along x [m]

 private:
  rod::Rod rod_;
  double dt_;
};

}  // namespace cosserat_cable::bench
