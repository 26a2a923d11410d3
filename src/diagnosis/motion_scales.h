// How large the motion in a set's records is: what thresholds, times and places are measured by.
#pragma once

#include <map>
#include <string>

#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/fit/fit_problem.h"

namespace cosserat_cable {

struct MotionScales {
  CableKeys keys;           ///< of the cable as it was fitted
  double EI = 0, GJ = 0;    ///< [N m^2]
  double length = 0;        ///< of the longest specimen [m]
  double shortest = 0;      ///< of the shortest [m]
  double period = 0;        ///< of the slowest swing [s]
  double clamp_moment = 0;  ///< largest change of the bending moment at a clamp [N m]
  double twist_moment = 0;  ///< likewise of the twisting moment at clamp a [N m]

  /// The stiffness that the simpler cause has found, by "a.bending" and the like [N m/rad].
  std::map<std::string, double> simpler;

  /// What a number of a hypothesis is a multiple of, in the number's unit.
  double Of(NumberScale scale, const std::string& path) const;
};

/// From a simulation of all experiments at a point of the problem.
MotionScales FindMotionScales(const FitProblem& problem, const FitPoint& at);

}  // namespace cosserat_cable
