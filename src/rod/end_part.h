// One end of a rod that is held in part: keeps its node where the clamp lets it, and bears on it
// with the clamp's springs.
#pragma once

#include <Eigen/Core>

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/rod/end_model.h"
#include "element.h"
#include "end_laws.h"
#include "prescribed_motion.h"

namespace cosserat_cable::rod {

class EndPart {
 public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  explicit EndPart(const EndModel& model);

  /// Whether anything is held.
  bool holds() const { return holds_; }
  bool holds_rotation() const { return holds_rotation_; }
  /// Whether the clamp exerts anything.
  bool bears() const { return holds_ || sprung_; }
  /// Whether the node is an unknown on which this end bears.
  bool active() const { return active_; }

  const Motion& clamp() const { return clamp_.motion(); }
  /// All of what moves it, to be put back where a step fails.
  const PrescribedMotion& prescribed() const { return clamp_; }
  void PutBack(const PrescribedMotion& clamp) { clamp_ = clamp; }
  void Start(const Motion& clamp) { clamp_.Start(clamp); }
  void ExchangeState(StateArchive* state) {
    clamp_.ExchangeState(state);
    laws_.ForEach([&](EndLaw* law) { law->ExchangeState(state); });
  }
  void MoveTo(const Pose& clamp, const StepCoefficients& c) { clamp_.MoveTo(clamp, c); }

  /// Puts what is held of the node's pose where the clamp has it.
  void ImposePose(Node<double>* node) const;

  /// What laws with internal variables go by.
  enum class Memory {
    kKept,   ///< where the last step has left them
    kRested  ///< as of an end that has come to where it is once, straight from zero
  };
  /// Moment of springs, dashpots and laws on the node [N m], section frame.
  Eigen::Vector3d SpringMoment(const Node<double>& node, Memory memory = Memory::kKept) const;
  /// Minus its derivative by the section's rotation, where d(rate)/d(rotation) is `rate_factor`
  /// [1/s]: symmetric, not negative.
  Eigen::Matrix3d SpringTangent(const Node<double>& node, double rate_factor,
                                Memory memory = Memory::kKept) const;
  /// Second derivative of the potential of what the clamp exerts at rest, symmetric, where it
  /// balances a moment of `missing` [N m] (section frame) on the section: what SpringTangent leaves
  /// out, because it is not positive, included. Laws give their tangent at the present state.
  Eigen::Matrix3d StaticTangent(const Node<double>& node, const Eigen::Vector3d& missing) const;
  /// Rotation of the section (section frame) by increment of psi, whose components are held or not.
  Eigen::Matrix3d RotationByPsi(const Node<double>& node) const;
  /// Of which SpringMoment at rest is minus the derivative [J].
  double SpringPotential(const Node<double>& node, Memory memory) const;
  double SpringEnergy(const Node<double>& node) const;           ///< stored [J]
  double SpringDissipationRate(const Node<double>& node) const;  ///< by the rate [W]

  /// The internal variables of laws take the state at a step's end: returns what they have turned
  /// into heat [J]. With a rested memory: that after a long rest.
  double CommitLaws(const Node<double>& node, Memory memory);

  /// Orthogonal projector onto the displacements and rotations (section frame) that are free.
  Matrix6 FreeProjector(const Node<double>& node) const;

  /// Power [W] that the clamp puts in where it exerts `force` [N] (world) and `moment` [N m]
  /// (section frame) on the node.
  double Power(const Node<double>& node, const Vec3<double>& force,
               const Vec3<double>& moment) const;

 private:
  /// The node's section as seen from the clamp.
  struct Relative {
    Eigen::Matrix3d R_WC;
    Eigen::Vector3d psi;      // [rad]
    Eigen::Vector3d psi_dot;  // [rad/s]
  };
  Relative Compare(const Node<double>& node) const;
  EndLaw::Resistance Resist(const Relative& of, Memory memory) const;

  EndModel model_;
  EndLaws laws_;
  bool rigid_, holds_, holds_rotation_, sprung_, active_;
  PrescribedMotion clamp_;
};

/// Both ends of a rod.
struct EndParts {
  EndPart a, b;

  bool active() const { return a.active() || b.active(); }
  /// Calls `act(end, whether it is b)`.
  template <class Act>
  void ForEachActive(Act act) const {
    if (a.active()) act(a, false);
    if (b.active()) act(b, true);
  }
};

}  // namespace cosserat_cable::rod
