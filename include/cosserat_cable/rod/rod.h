// A geometrically exact Cosserat rod with Kelvin-Voigt damping: statics and implicit dynamics.
//
// Two-node elements with strains at the geodesic midpoint, shear corrected for the residual bending
// of the element, lumped mass: second order in the element length. Generalised-alpha in time:
// second order, no numerical damping worth the name. Each Newton iteration is a block-tridiagonal
// solve, O(elements). All vectors in an inertial frame, SI units.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/rod/load.h"
#include "cosserat_cable/rod/section.h"

namespace cosserat_cable::rod {

struct PointMass {
  double s;     ///< arc length [m]; spread over the two nodes beside it
  double mass;  ///< [kg]
};

struct RodModel {
  double length = 0;  ///< unstressed [m]
  int elements = 40;
  Section section;
  std::vector<PointMass> masses;
  Eigen::Vector3d gravity = Eigen::Vector3d(0, 0, -9.81);  ///< [m/s^2]
  bool held_a = true, held_b = true;  ///< clamped ends; a free one moves as it likes
};

struct SolveReport {
  bool converged = false;
  int iterations = 0;
  double correction = 0;  ///< last Newton correction, relative to the length and in rad
};

struct Mode;  // modes.h

/// Force and moment that a clamp exerts on the rod [N], [N m], world.
struct Wrench {
  Eigen::Vector3d force, moment;
};

class Rod : public Centreline {
 public:
  explicit Rod(const RodModel& model);
  ~Rod() override;
  Rod(const Rod& other);
  Rod(Rod&&) noexcept;
  Rod& operator=(Rod&&) noexcept;

  const RodModel& model() const;
  int elements() const override;

  /// Sets the configuration, at rest. `nodes`: elements + 1 poses, a3 along growing s.
  void SetConfiguration(const std::vector<Pose>& nodes);
  /// Adds the velocities of a rigid motion: of the frame whose origin is at `p` [m] with velocity v
  /// [m/s] and angular velocity omega [rad/s], all in world axes.
  void AddRigidMotion(const Eigen::Vector3d& p, const Eigen::Vector3d& v,
                      const Eigen::Vector3d& omega);

  /// Static equilibrium by energy minimisation from the present configuration (regularised Newton
  /// with a line search); held ends stay where they are. Velocities become zero.
  SolveReport Equilibrate(const Load* load = nullptr);

  /// Advances by `dt` [s] to held ends that move like `a` and `b`. Where it does not converge the
  /// state is left as it was.
  SolveReport Step(double dt, const Motion& a, const Motion& b, const Load* load = nullptr);

  /// Where the nodes would be after `dt` with unchanged velocities; ends as in `a`, `b`. What
  /// contact is searched at.
  void Predict(double dt, const Motion& a, const Motion& b,
               std::vector<Eigen::Vector3d>* positions) const;

  // The state.
  Vec3<double> position(int node) const override;
  Vec3<double> velocity(int node) const override;
  Pose pose(int node) const;
  Eigen::Vector3d angular_velocity(int node) const;  ///< section frame [rad/s]
  Eigen::Vector3d acceleration(int node) const;      ///< of the position [m/s^2]
  Eigen::Vector3d force(int element) const;          ///< F along a1, a2, a3 [N]
  Eigen::Vector3d moment(int element) const;         ///< M about a1, a2, a3 [N m]
  Eigen::Vector3d curvature(int element) const;      ///< K [1/m]
  Wrench reaction_a() const;
  Wrench reaction_b() const;
  double kinetic_energy() const;  ///< [J]
  double elastic_energy() const;  ///< [J]
  double gravity_energy() const;  ///< [J], zero at the world's origin

 private:
  friend class RodBatch;
  friend std::vector<Mode> FindModes(const Rod& rod, int count, const Load* load);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosserat_cable::rod
