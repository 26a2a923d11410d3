// The arch as a user of MuJoCo would build it: a chain of capsules in ball joints.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

#include "swept_arch.h"

namespace cosserat_cable::bench {

struct MujocoSetting {
  int elements;            ///< joints; even, so that a capsule's middle is the apex
  double dt;               ///< [s]
  std::string integrator;  ///< Euler, implicit or RK4
  std::string solver;      ///< PGS, CG or Newton
};

/// Capsules of length h around the nodes of a rod with elements of length h (the two at the clamps
/// are halves), joined where the rod's elements have their midpoints: second order in h.
///
/// A ball joint has one stiffness for all directions: EI/h, and eta_EI/h likewise. Three hinges
/// could hold GJ apart, but in a plane nothing twists. Both ends are welded to mocap bodies, for
/// MuJoCo takes these for standing still: what hangs from one would not feel it accelerate. There
/// is no shear and no stretch.
class MujocoChain {
 public:
  /// In the shape in which the rod of as many elements rests.
  MujocoChain(const SweptArch& arch, const MujocoSetting& setting);

  /// Lets the chain find its own rest, and gives it the velocity of the sweep's begin; false as
  /// Step.
  bool Start();
  /// A step that ends with both clamps shifted along x [m]; false: MuJoCo found a state that cannot
  /// be, and has reset itself.
  bool Step(double shift);
  double Apex() const { return data_->xpos[3 * apex_]; }  ///< along x [m]
  double End() const { return data_->xpos[3 * end_]; }    ///< the cable's first end, along x [m]

 private:
  std::unique_ptr<mjModel, void (*)(mjModel*)> model_{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, void (*)(mjData*)> data_{nullptr, mj_deleteData};
  double dt_;       // s
  int apex_, end_;  // bodies
};

}  // namespace cosserat_cable::bench
