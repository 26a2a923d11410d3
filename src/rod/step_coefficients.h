// A step of generalised-alpha as linear functions of the increment.
#pragma once

#include "cosserat_cable/rod/generalized_alpha.h"

namespace cosserat_cable::rod {

struct StepCoefficients {
  explicit StepCoefficients(double step) : dt(step) {
    constexpr GeneralizedAlpha kScheme{};
    const double algorithm_by_increment = 1 / (kScheme.beta * dt * dt);
    velocity_by_increment = kScheme.gamma / (kScheme.beta * dt);
    const double new_algorithm = (1 - kScheme.alpha_m) / (1 - kScheme.alpha_f);
    old_algorithm = kScheme.alpha_m / (1 - kScheme.alpha_f);
    old_rate = -kScheme.alpha_f / (1 - kScheme.alpha_f);
    rate_by_increment = new_algorithm * algorithm_by_increment;
    algorithm_by_rate = 1 / new_algorithm;
    const double coasting_algorithm = -algorithm_by_increment * dt * dt * (0.5 - kScheme.beta);
    coasting_velocity = dt * (1 - kScheme.gamma) + dt * kScheme.gamma * coasting_algorithm;
    coasting_rate = new_algorithm * coasting_algorithm;
    old_mean = 1 - 2 * kScheme.beta;
    new_mean = 2 * kScheme.beta;
  }

  double dt;                       ///< [s]
  double velocity_by_increment;    ///< d v_1/d(increment) [1/s]
  double rate_by_increment;        ///< d vdot_1/d(increment) [1/s^2]
  double old_algorithm, old_rate;  ///< d vdot_1/d a_0, d vdot_1/d vdot_0
  double algorithm_by_rate;        ///< d a_1/d vdot_1
  double old_mean, new_mean;       ///< d mean/d a_0, d mean/d a_1; see ChainState
  // With the increment dt v_0:
  double coasting_velocity;  ///< d v_1/d a_0 [s]
  double coasting_rate;      ///< d vdot_1/d a_0, besides `old_algorithm`
};

}  // namespace cosserat_cable::rod
