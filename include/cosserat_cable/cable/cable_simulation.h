// One cable in motion: the rod, its clamps, and the bodies it touches.
//
// Everything is in an inertial world frame W. Step is the only way in which time advances: live, in
// replay, in a fit, in a benchmark. Same input, same bits.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/contact/body.h"
#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/rod/energy.h"
#include "cosserat_cable/rod/load.h"
#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable {

/// Everything that drives a cable, in W, at one instant.
struct Surroundings {
  Motion a, b;                    ///< the clamps' section frames
  std::vector<Motion> obstacles;  ///< of the bodies given at construction, in their order
  /// What acts on the cable beside gravity, its own loads and contact; null: nothing. Outlives the
  /// simulation's use of these surroundings, which ends with the next step.
  const rod::Load* load = nullptr;
  /// The section from here on, of a cable that changes in time; null: it stays as it is.
  const rod::Section* section = nullptr;
};

struct StepOutcome {
  bool ok = true;
  int iterations = 0;   ///< Newton iterations, over all substeps
  int substeps = 1;     ///< more than one where the step had to be retried smaller
  std::string message;  ///< why it failed, where it did
  std::string remark;   ///< on where it came to rest, where that is not what it may seem
};

/// What is done about an equilibrium from which the slightest motion makes the cable fall.
enum class Unstable {
  kStays,  ///< nothing, and nothing is said
  kFalls   ///< the cable falls to one side into a stable one, where there is one; a remark says so
};

/// One place where the cable presses on a body.
struct ContactPoint {
  int obstacle = -1;                    ///< index of the body; -1: no contact
  double s = 0;                         ///< arc length [m]
  Eigen::Vector3d position_W, force_W;  ///< on the cable's surface [m]; on the cable [N]
  double penetration = 0;               ///< [m]
};

/// What a cable tells about its state; vectors in W.
struct CableReport {
  Eigen::Vector3d apex, apex_velocity;  ///< [m], [m/s]
  double curvature_max = 0;             ///< [1/m]
  double clearance =
      std::numeric_limits<double>::infinity();  ///< surface to the nearest body [m]; negative:
                                                ///< penetration; +inf: none within reach
  double contact_force = 0;                     ///< sum of the normal forces' magnitudes [N]
  double tension_max = 0;                       ///< largest axial force [N] (positive: tension)
  Eigen::Vector3d force_a, moment_a;            ///< by clamp a on the cable [N], [N m]
  Eigen::Vector3d force_b, moment_b;
  rod::EnergyBalance energy;  ///< since the cable settled; loads are contact and what was given
};

/// Where a cable and the bodies around it are at one instant, in W.
struct CablePosture {
  Pose a;                              ///< the clamp's section frame
  std::vector<Eigen::Vector3d> nodes;  ///< [m]
  std::vector<Motion> obstacles;
};

class CableSimulation {
 public:
  /// The bodies outlive the simulation. `clearance_reach` [m]: bodies farther away count as none.
  CableSimulation(const CableModel& model, std::vector<const Body*> obstacles,
                  const Eigen::Vector3d& gravity_W, double clearance_reach = 0.05);
  /// A cable that is at its start already, in any state, and may be held otherwise than by two
  /// clamps, or carry more than its file says. `rod`: of the model's length and elements. `now`:
  /// clamps and bodies at the start.
  CableSimulation(const CableModel& model, rod::Rod rod, const Surroundings& now,
                  std::vector<const Body*> obstacles = {}, double clearance_reach = 0.05);
  ~CableSimulation();
  CableSimulation(CableSimulation&&) noexcept;
  CableSimulation& operator=(CableSimulation&&) noexcept;

  /// Static equilibrium at these poses (reached without twist or loop from the straight cable),
  /// moving as if it had followed clamps and bodies through equilibria so far.
  StepOutcome Settle(const Surroundings& now, Unstable unstable = Unstable::kStays);

  /// Advances by `dt` [s] to the instant at which `then` holds. A step that does not converge is
  /// taken in parts: between the two instants clamps and bodies go as MotionBetween says, under the
  /// load and with the section of `then`. On failure the state stays the last good one.
  StepOutcome Step(double dt, const Surroundings& then);

  /// All that changes in time, in numbers that mean nothing outside: with them in SetState, a
  /// simulation of the same model, bodies and gravity takes the same steps, to the last bit.
  std::vector<double> State() const;
  /// @throws std::invalid_argument where they are not those of such a simulation; it has to settle,
  /// or to take another state, before it goes on
  void SetState(const std::vector<double>& state);

  const CableModel& model() const;
  const rod::Rod& rod() const;

  /// Centreline and section frames at the `elements + 1` nodes, in W.
  const std::vector<Pose>& nodes() const;
  /// One of them.
  Pose node(int i) const;
  /// Magnitude of the bending curvature in each element [1/m], `elements` values.
  std::vector<double> curvatures() const;
  std::vector<ContactPoint> contacts() const;
  /// The one that is deepest.
  ContactPoint DeepestContact() const;
  /// Natural modes about the present configuration, where Settle has found it: clamps and bodies
  /// stay, the latter push back where they are touched. See rod/modes.h, also for errors thrown.
  std::vector<rod::Mode> FindModes(int count) const;
  CableReport Report();
  /// All of a report but its clearance, which is left at +inf.
  CableReport ReportForces() const;
  CablePosture posture() const;
  /// From the cable's surface to the nearest body [m], see CableReport; may be asked while the
  /// cable is stepped on. Not const: it remembers distances, which makes the next answer cheap.
  double Clearance(const CablePosture& posture);

 private:
  friend class CableFleet;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosserat_cable
