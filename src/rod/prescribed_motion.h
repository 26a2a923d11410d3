// A clamp as the time step sees it: led through given poses, with the velocities that the step's
// own difference scheme makes of them.
//
// The nodes' velocities are those of generalised-alpha, off the true ones by (w dt)^2/12. Beside
// them, the exact velocity of a clamp would strain the first element by that share of the whole
// vehicle's motion. From the poses, by the same scheme, a rigid motion stays rigid.
#pragma once

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/math/state_archive.h"
#include "step_coefficients.h"

namespace cosserat_cable::rod {

class PrescribedMotion {
 public:
  const Motion& motion() const { return motion_; }

  /// Moves like `motion` at this instant.
  void Start(const Motion& motion) {
    motion_ = motion;
    algorithm_ = {motion.a, motion.alpha};
  }

  void ExchangeState(StateArchive* state) {
    state->Exchange(&motion_, &algorithm_.v, &algorithm_.omega);
  }

  /// A step later it is at `X`.
  void MoveTo(const Pose& X, const StepCoefficients& c) {
    Motion next;
    next.X = X;
    const Eigen::Vector3d turn = RotationLog((motion_.X.q.conjugate() * X.q).normalized());
    const Rates rates = {motion_.a, motion_.alpha};
    Advance(c, X.p - motion_.X.p, motion_.v, rates.v, &algorithm_.v, &next.v, &next.a);
    Advance(c, turn, motion_.omega, rates.omega, &algorithm_.omega, &next.omega, &next.alpha);
    motion_ = next;
  }

 private:
  struct Rates {
    Eigen::Vector3d v = Eigen::Vector3d::Zero(), omega = Eigen::Vector3d::Zero();
  };
  /// As a node that is moved by `increment` instead of by its coasting velocity.
  static void Advance(const StepCoefficients& c, const Eigen::Vector3d& increment,
                      const Eigen::Vector3d& velocity, const Eigen::Vector3d& rate,
                      Eigen::Vector3d* algorithm, Eigen::Vector3d* next_velocity,
                      Eigen::Vector3d* next_rate) {
    const Eigen::Vector3d beyond = increment - c.dt * velocity;
    *next_velocity = velocity + c.coasting_velocity * *algorithm + c.velocity_by_increment * beyond;
    *next_rate = (c.coasting_rate + c.old_algorithm) * *algorithm + c.old_rate * rate +
                 c.rate_by_increment * beyond;
    *algorithm =
        c.algorithm_by_rate * (*next_rate - c.old_algorithm * *algorithm - c.old_rate * rate);
  }

  Motion motion_;
  Rates algorithm_;  // generalised-alpha's own accelerations
};

}  // namespace cosserat_cable::rod
