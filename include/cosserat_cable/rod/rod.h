// A geometrically exact Cosserat rod with Kelvin-Voigt damping: statics and implicit dynamics.
//
// Two-node elements with strains at the geodesic midpoint, of the arc through their nodes; shear
// corrected for the residual bending of the element; lumped mass: second order in the element
// length, with errors of 0.2 % at most where ten elements make an arch. Generalised-alpha in time:
// second order, no numerical damping worth the name. Each Newton iteration is a block-tridiagonal
// solve, O(elements). All vectors in an inertial frame, SI units.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/rod/end_model.h"
#include "cosserat_cable/rod/energy.h"
#include "cosserat_cable/rod/load.h"
#include "cosserat_cable/rod/section.h"
#include "cosserat_cable/rod/section_branch.h"
#include "cosserat_cable/rod/section_law.h"

namespace cosserat_cable::rod {

/// A small rigid body whose centre of mass is on the centreline: a connector, a clip, a disc.
struct LumpedBody {
  double s;     ///< arc length [m]; spread over the two nodes beside it
  double mass;  ///< [kg]
  /// Principal moments of inertia about the section's a1, a2, a3 [kg m^2].
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();
};

/// A rigid joint between two pieces of a rod, an elbow: behind it the section's frame is R turn,
/// where it is R before.
struct Joint {
  double s;  ///< arc length [m], at a node
  Eigen::Quaterniond turn;
};

struct RodModel {
  double length = 0;  ///< unstressed [m]
  int elements = 40;
  Section section;
  /// What the section has beside its Kelvin-Voigt elements; each rod clones them.
  std::vector<std::shared_ptr<const SectionBranch>> branches;
  std::vector<std::shared_ptr<const SectionLaw>> laws;
  std::vector<LumpedBody> bodies;
  /// A node's own frame is the one before its joint.
  std::vector<Joint> joints;
  Eigen::Vector3d gravity = Eigen::Vector3d(0, 0, -9.81);  ///< [m/s^2]
  EndModel a, b;
  /// What always acts on it beside the loads that a call is given: the air, an obstacle.
  std::vector<std::shared_ptr<const Load>> loads;
};

struct SolveReport {
  bool converged = false;
  int iterations = 0;
  double correction = 0;  ///< last of Newton's, relative to the length and in rad
};

struct Mode;  // modes.h

struct ElementStress;
template <class T>
struct Node;
class RodHome;
template <class T>
class ChainStepper;

/// Force and moment that a clamp, with its springs, exerts on the rod [N], [N m], world.
struct Wrench {
  Eigen::Vector3d force, moment;
};

class Rod : public Centreline {
 public:
  /// @throws std::invalid_argument where a joint is not at a node between the ends
  explicit Rod(const RodModel& model);
  ~Rod() override;
  Rod(const Rod& other);
  Rod(Rod&&) noexcept;
  Rod& operator=(Rod&&) noexcept;

  const RodModel& model() const;
  int elements() const override;

  /// Sets the configuration, at rest. `nodes`: elements + 1 poses, a3 along growing s. The clamps
  /// are where the end nodes are.
  void SetConfiguration(const std::vector<Pose>& nodes);
  /// Takes another section law from the next step, or equilibrium, on: parameters that change in
  /// time. Strains, and the unstressed ones' places, are as they were; the stresses that are read
  /// before are still the old law's. Its mass and inertia do not count. Not for a rod that is
  /// shared with a running step.
  void SetSection(const Section& section);
  /// Puts the clamps' frames somewhere else, for the next Equilibrate.
  void SetClamps(const Pose& a, const Pose& b);
  /// Sets nodes and clamps moving as a rigid body: with a frame that has this motion in the world.
  void AddRigidMotion(const Motion& frame);

  /// Sets nodes and clamps moving: `nodes`, elements + 1 of them, at their present poses, and the
  /// clamps' frames. Within the first step the forces become those that this motion asks for.
  void SetMotion(const std::vector<Motion>& nodes, const Motion& a, const Motion& b);

  /// Sets the nodes' velocities [m/s] (world) and angular velocities [rad/s] (section frame);
  /// `elements + 1` of each. What the clamps hold stays at rest.
  void SetVelocities(const std::vector<Eigen::Vector3d>& v,
                     const std::vector<Eigen::Vector3d>& omega);

  /// Static equilibrium by energy minimisation from the present configuration (regularised Newton
  /// with a line search) with the ends held by the clamps. Velocities become zero. Under a load
  /// without a potential, by Newton's method with bounded steps: then from near enough. Laws of
  /// sections and ends forget what they were: they come to this rest once, straight from the
  /// unstressed state.
  SolveReport Equilibrate(const Load* load = nullptr);
  /// The same from a configuration that is nearly there, without a detour by way of rods that
  /// stretch more easily: for loads that hold only where they were seen, as contact.
  SolveReport EquilibrateNearby(const Load* load = nullptr);
  /// The next of a slow sequence of equilibria: laws go on from where the last state left them. The
  /// first one after SetConfiguration has no past: it is as of Equilibrate.
  SolveReport EquilibrateWithHistory(const Load* load = nullptr);

  /// All that changes in time, in numbers that mean nothing outside: with them in SetState, a rod of
  /// the same model takes the same steps, to the last bit.
  std::vector<double> State() const;
  /// @throws std::invalid_argument where they are not those of a rod of the same model
  void SetState(const std::vector<double>& state);

  /// Advances by `dt` [s] to clamps at `a` and `b`. Their velocities are those that the time scheme
  /// makes of their poses, so that a rigid motion strains nothing. Where it does not converge the
  /// state is left as it was.
  SolveReport Step(double dt, const Pose& a, const Pose& b, const Load* load = nullptr);

  /// Where the nodes would be after `dt` with unchanged velocities; ends as in `a`, `b`. What
  /// contact is searched at.
  void Predict(double dt, const Pose& a, const Pose& b,
               std::vector<Eigen::Vector3d>* positions) const;

  /// The time [s] that loads are told; grows with each step, 0 at first.
  void SetTime(double time);
  double time() const override;
  Motion clamp_a() const override;

  // The state.
  Vec3<double> position(int node) const override;
  Vec3<double> velocity(int node) const override;
  Quat<double> orientation(int node) const override;
  Pose pose(int node) const;
  Pose pose_behind(int node) const;  ///< as the element behind sees it: after a joint
  Eigen::Vector3d angular_velocity(int node) const;  ///< section frame [rad/s]
  Eigen::Vector3d acceleration(int node) const;      ///< of the position [m/s^2]
  Eigen::Vector3d force(int element) const;          ///< F along a1, a2, a3 [N]
  Eigen::Vector3d moment(int element) const;         ///< M about a1, a2, a3 [N m]
  Eigen::Vector3d curvature(int element) const;      ///< K [1/m]
  Wrench reaction_a() const;
  Wrench reaction_b() const;
  double kinetic_energy() const;  ///< [J]
  double elastic_energy() const;  ///< [J], of the section's and the clamps' springs
  double gravity_energy() const;  ///< [J], zero at the world's origin
  /// Where the energy came from and went since the configuration was last set or equilibrated;
  /// after SetMotion since the first step.
  EnergyBalance energy_balance() const;

 private:
  friend class RodBatch;
  friend class RodHome;
  template <class T>
  friend class ChainStepper;
  friend std::vector<Mode> FindModes(const Rod& rod, int count, const Load* load);
  Node<double> NodeAt(int node) const;
  const ElementStress& StressAt(int element) const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosserat_cable::rod
