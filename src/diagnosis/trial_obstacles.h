// Where a diagnosis begins to look for an obstacle: there is no amplitude that it could grow from,
// so planes and pegs are tried in the way of the motion.
#pragma once

#include <vector>

#include "cosserat_cable/fit/fit_problem.h"
#include "trial.h"

namespace cosserat_cable {

/// Trials of the cause `contact` in clamp a's frame, each in the way of some part of the motion
/// that the model at a point makes.
std::vector<Trial> TrialObstacles(const FitProblem& problem, const FitPoint& at);

}  // namespace cosserat_cable
