#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "effects/effect.h"
#include "excitation.h"
#include "rod_dynamics.h"

namespace cosserat_cable::generator {

/// What a column of a record holds.
struct Channel {
  enum class Quantity { kPosition, kVelocity, kAcceleration, kAngle, kRate };
  std::string column;
  double s = 0.0;  ///< [m]
  Quantity quantity = Quantity::kPosition;
  int axis = 0;  ///< of the world frame; means nothing for angle and rate
};

/// One experiment on one specimen. Clamp a is fixed for a ring-down (`disc` is empty and `held` is
/// given), a torsional pendulum (`disc` and `twisted`) and slow bending (`tip_forces`: one
/// equilibrium each); it moves from rest where `drive` is given, with the end free or held at `b`.
struct Experiment {
  std::string name;
  std::string kind;
  CableData cable;
  Eigen::Vector3d gravity{0.0, 0.0, -9.81};  ///< [m/s^2]
  FrameMotion a;
  std::optional<Disc> disc;
  bool guided = false;  ///< the disc turns about and slides along clamp a's axis only
  std::optional<Eigen::Vector3d> held;  ///< where the end is held before it is let go [m]
  /// How far from rest and in which direction it was pulled to get there [m]; where a set has
  /// effects, `held` is where it gets with them. 0: `held` says all.
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();
  double twisted = 0.0;                     ///< angle at which the disc is held [rad]
  std::optional<Excitation> drive;          ///< starts at `a`
  std::optional<FrameMotion> b;             ///< fixed
  std::vector<Eigen::Vector3d> tip_forces;  ///< world [N]
  std::vector<EffectChoice> effects;
  std::vector<Channel> channels;
  Eigen::VectorXd times;  ///< [s], the first is the release; of tip_forces the steps' numbers
};

/// Defaults chosen by the convergence tests.
struct Accuracy {
  Resolution resolution;
  double tolerance = 1e-7;  ///< of the integrator, relative to the release's distance from rest
};

/// What an ideal sensor would have recorded.
struct Record {
  Eigen::MatrixXd values;  ///< times x channels
  Eigen::VectorXd rest;    ///< what each channel shows in the end
  RadauCounts counts;
};

/// The rod of an experiment in its surroundings and with its effects, before anything pulls or
/// twists it.
RodDynamics makeRig(const Experiment& experiment, const Resolution& resolution);

/// The rest shape before the experiment starts, reached from the straight rod.
Eigen::VectorXd restOf(const Experiment& experiment, RodDynamics* rod);

Record simulate(const Experiment& experiment, const Accuracy& accuracy = {});

/// Where the end comes to rest when pulled along `direction` so far that it is `distance` [m] from
/// where it hangs by itself; to within a few percent.
Eigen::Vector3d pulledEnd(const Experiment& experiment, const Eigen::Vector3d& direction,
                          double distance);

}  // namespace cosserat_cable::generator
