#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "effects/effect.h"
#include "frame_motion.h"
#include "radau.h"
#include "rod.h"
#include "rod_shape.h"

namespace cosserat_cable::generator {

/// A rigid body at end b, its centre of mass on the axis there.
struct Disc {
  double inertia = 0.0;  ///< about a3 [kg m^2]; half of it about a1 and a2
  double mass = 0.0;     ///< [kg]
  double dashpot = 0.0;  ///< D_E: a moment -D_E times the spin about a3 [N m s]
};

/// What holds the section at end b: components in the frame of `pose`. Springs and dashpots so
/// stiff (kHoldStiffness times the rod's own) that they give way by less than any data show.
struct EndHold {
  FrameCurve pose;
  std::array<bool, 3> position{true, true, true};
  std::array<bool, 3> rotation{true, true, true};
};

/// Where and how a material point moves.
struct PointMotion {
  Eigen::Vector3d position, velocity, acceleration;  ///< [m], [m/s], [m/s^2]
};

/// Equations of motion of a rod clamped at s = 0, in its strain coordinates: internal forces
/// follow from the inertia of all that lies beyond a section, and are weighed against the section
/// laws in the sense of Galerkin (d'Alembert's principle in minimal coordinates). Where an effect
/// lets clamp a give way, the rotation vector of the section there against the clamp (two
/// components for bending, one for torsion) follows the strains among the coordinates.
class RodDynamics : public SecondOrderSystem {
 public:
  /// @param breaks further arc lengths [m] at which elements end, besides those of point masses.
  RodDynamics(const Rod& rod, const Resolution& resolution, const std::vector<double>& breaks = {});

  // What surrounds the rod; set before use.
  Eigen::Vector3d gravity{0.0, 0.0, -9.81};  ///< [m/s^2]
  FrameCurve clamp = [](double) { return FrameMotion(); };
  Disc disc;
  std::vector<EndHold> holds;  ///< none or one
  /// Constant forces [N] at arc lengths at which elements end.
  std::vector<std::pair<double, Eigen::Vector3d>> forces;
  double end_torque = 0.0;  ///< about a3 at end b [N m]
  /// Statics: what relaxes has relaxed, and the clamp's motion makes no inertia.
  bool settled = false;

  /// Adds what the plain rod lacks. Before use; the rod must have been made for it (equip()).
  void addEffect(std::shared_ptr<Effect> effect);
  bool hasEffects() const { return !effects_.empty(); }
  /// Of the rod with its effects [rad/m].
  double unstressedTwist() const {
    double sum = 0.0;
    for (const auto& effect : effects_) sum += effect->unstressedTwist();
    return sum;
  }
  /// Makes the state the effects' history.
  void commit(const MotionState& state);

  const Rod& rod() const { return rod_; }
  const RodShape& shape() const { return shape_; }

  int size() const override { return shape_.size() + hinge_; }
  Eigen::VectorXd residual(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                           const Eigen::VectorXd& a) override;
  void linearise(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                 const Eigen::VectorXd& a, Eigen::MatrixXd* M, Eigen::MatrixXd* D,
                 Eigen::MatrixXd* K) override;
  Eigen::VectorXd scale() const override;
  bool abrupt() const override;
  void expectStep(double h) override { ahead_ = h; }

  /// Motion of the point at the arc length that `station` = shape().integralTo(s) stands for.
  PointMotion pointMotion(const MotionState& state, const Eigen::RowVectorXd& station) const;
  /// Integral of twist from 0 to there [rad] for coordinates q, its rate [rad/s] for velocities.
  double twist(const Eigen::VectorXd& q, const Eigen::RowVectorXd& station) const;
  /// Force and moment [N, N m] by the clamp on the rod at s = 0, world axes.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> clampLoad(const MotionState& state);

  /// Kinetic, elastic and gravitational energy [J] and the power lost [W].
  struct Energy {
    double kinetic = 0.0, elastic = 0.0, potential = 0.0, loss = 0.0;
    double total() const { return kinetic + elastic + potential; }
  };
  Energy energy(const MotionState& state) const;

 private:
  struct Kinematics {
    Eigen::Matrix3Xd frames;  ///< of all points, world
    Points K, Kd, G, Gd;      ///< at nodes, section components
    Points rp;                ///< r' at nodes, world
    Points v_s, a_s;          ///< derivatives of velocity and acceleration by s at nodes
    Points w, alpha;          ///< angular velocity and acceleration at all points
    Points a;                 ///< acceleration at all points
    FrameMotion base;         ///< of clamp a
    ClampTurn turn;           ///< of the section against it
    Eigen::Matrix3d swivel;   ///< angular velocity of the section over the turn's rate, world
  };
  struct Internal {
    Points n, m;                    ///< at nodes, world
    Eigen::Vector3d force, moment;  ///< at s = 0
  };
  Kinematics kinematics(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                        const Eigen::VectorXd& a) const;
  Internal internal(double t, const Kinematics& k) const;
  void holdLoad(double t, const Kinematics& k, const EndHold& hold, Eigen::Vector3d* force,
                Eigen::Vector3d* moment) const;
  double holdForceStiffness() const;
  double holdMomentStiffness() const;
  double holdTime() const;
  bool holdGives(int component) const;
  ClampTurn holdTurn(double t, const Kinematics& k) const;
  Eigen::Vector3d clampMoment(int end, const ClampTurn& turn) const;
  Points stationForces(double t, const Kinematics& k, const Points& position,
                       const Points& velocity) const;
  Points stationPositions(const Kinematics& k) const;
  Points stationVelocities(const Kinematics& k) const;
  /// Derivatives by a clamp's turn and its rate, by differences.
  void lineariseClamp(int end, const ClampTurn& turn, Eigen::Matrix3d* spring,
                      Eigen::Matrix3d* dashpot) const;
  void lineariseEffects(double t, const Kinematics& k, const Eigen::MatrixXd* slope,
                        Eigen::MatrixXd* D, Eigen::MatrixXd* K) const;
  Eigen::Vector3d hingePart(const Eigen::VectorXd& x) const;
  int hingeAxis(int j) const { return hinge_ == 1 ? 2 : j; }

  Rod rod_;
  RodShape shape_;
  std::vector<double> point_mass_;  ///< at element ends [kg]
  std::vector<std::shared_ptr<Effect>> effects_;
  int hinge_ = 0;       ///< rotations of the section at clamp a: torsion, bending, or all three
  double ahead_ = 0.0;  ///< the step that is about to be tried [s]
  // Stations of loads: places, weights, rows that integrate to them and that interpolate at them.
  Eigen::VectorXd station_s_, station_weights_;
  Eigen::MatrixXd station_integral_, station_values_;
};

}  // namespace cosserat_cable::generator
