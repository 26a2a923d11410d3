// How an end of a rod is held: by a clamp, a pin, a slide, a clamp that gives way, or not at all.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "cosserat_cable/rod/end_law.h"

namespace cosserat_cable::rod {

/// Components are those of the clamp's own frame, which moves as the user says. The end's section
/// sits at the clamp's origin and is turned against it by the rotation vector psi = log(R_C^T R);
/// both are zero in a clamp that holds everything.
struct EndModel {
  std::array<bool, 3> translation{true, true, true};  ///< held along the axes
  std::array<bool, 3> rotation{true, true, true};     ///< held about the axes (components of psi)
  /// Spring and dashpot about each axis that is not held: the moment -k psi - d dpsi/dt acts on the
  /// section [N m/rad], [N m s/rad].
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();
  Eigen::Vector3d damping = Eigen::Vector3d::Zero();
  /// What acts beside them about the axes that are not held; each rod clones them.
  std::vector<std::shared_ptr<const EndLaw>> laws{};

  static EndModel Clamped() { return {}; }
  static EndModel Pinned() {
    EndModel end;
    end.rotation = {false, false, false};
    return end;
  }
  static EndModel Free() {
    EndModel end = Pinned();
    end.translation = {false, false, false};
    return end;
  }
  /// Held in place by a joint that gives way in rotation.
  static EndModel Sprung(const Eigen::Vector3d& stiffness, const Eigen::Vector3d& damping) {
    EndModel end = Pinned();
    end.stiffness = stiffness;
    end.damping = damping;
    return end;
  }

  /// Everything is held: the end's node moves with the clamp.
  bool clamped() const {
    return translation[0] && translation[1] && translation[2] && rotation[0] && rotation[1] &&
           rotation[2];
  }
  /// Neither clamped nor free: the end's node is an unknown on which the clamp bears.
  bool partly_held() const {
    const bool holds = translation[0] || translation[1] || translation[2] || rotation[0] ||
                       rotation[1] || rotation[2];
    return !clamped() && (holds || stiffness.any() || damping.any() || !laws.empty());
  }
};

}  // namespace cosserat_cable::rod
