#pragma once

#include <Eigen/Core>

#include "rod_dynamics.h"

namespace cosserat_cable::generator {

// Where the rod has effects, equilibria are settled ones, and those that follow a path make history
// at each of its stages: from straight to the rest shape, from there to where the rod is held.

/// Equilibrium nearest to `guess` at time t, by Newton's method with a line search. Throws
/// std::runtime_error where it does not converge.
Eigen::VectorXd equilibrium(RodDynamics& rod, const Eigen::VectorXd& guess, double t = 0.0);

/// Equilibrium reached from the straight rod while gravity, forces and torque grow together.
Eigen::VectorXd loadedEquilibrium(RodDynamics& rod);

/// Makes the equilibrium q the history of the rod's effects.
void remember(RodDynamics& rod, const Eigen::VectorXd& q, double t = 0.0);

/// Adds the force at s that moves this point to `position`, from the rest shape along a straight
/// line; the rod's `forces` then end with it.
Eigen::VectorXd heldEquilibrium(RodDynamics& rod, const Eigen::VectorXd& rest, double s,
                                const Eigen::Vector3d& position);

/// Sets the rod's end torque to what makes the twist of the whole length `angle` [rad].
Eigen::VectorXd twistedEquilibrium(RodDynamics& rod, const Eigen::VectorXd& rest, double angle);

}  // namespace cosserat_cable::generator
