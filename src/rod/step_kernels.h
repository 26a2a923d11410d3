// The loops over nodes of one time step.
#pragma once

#include "block_tridiagonal.h"
#include "element.h"

namespace cosserat_cable::rod {

/// Time derivatives of a node's velocity [m/s^2] and of its angular velocity in the section's frame
/// [rad/s^2].
struct NodeRates {
  Vec3<double> v, omega;
};

/// Generalised-alpha as linear functions of the increment over a step of `dt` [s].
struct StepCoefficients {
  explicit StepCoefficients(double dt);

  double dt;
  double velocity_by_increment;                   ///< d v_1/d(increment) [1/s]
  double algorithm_by_increment;                  ///< d a_1/d(increment) [1/s^2]
  double rate_by_increment;                       ///< d vdot_1/d(increment) [1/s^2]
  double old_position;                            ///< dt^2 (1/2 - beta), of a_0 in the increment
  double old_velocity, new_velocity;              ///< dt (1 - gamma), dt gamma
  double new_algorithm, old_algorithm, old_rate;  ///< vdot_1 from a_1, a_0, vdot_0
};

/// One node's part in a step: where it was, and where the increment takes it.
struct NodeStep {
  const Node<double>* from;
  const NodeRates *algorithm, *rate;
  const Vec6<double>* increment;
  Node<double>* to;
  NodeRates *to_algorithm, *to_rate;
};

/// The states of nodes `first`..`last` that belong to their increments; the members of `step` point
/// to node 0.
void UpdateNodes(const StepCoefficients& c, const NodeStep& step, int first, int last);

/// Subtracts inertia forces and gyroscopic moments from `rhs`, all `count` nodes.
void SubtractInertia(const double* mass, const Vec3<double>* inertia, const Node<double>* nodes,
                     const NodeRates* rates, int count, Vec6<double>* rhs);

double Factorise(BlockTridiagonal<double>* system, int first, int last);
void Solve(const BlockTridiagonal<double>& system, Vec6<double>* x);

}  // namespace cosserat_cable::rod
