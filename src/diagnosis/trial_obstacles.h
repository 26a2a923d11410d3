// Where a diagnosis begins to look for an obstacle: there is no amplitude that it could grow from,
// so planes and pegs are tried in the way of the motion, as faint ones, which just touch it, and as
// whole ones: what follows an impact depends on it so much that a faint one does not lead there.
#pragma once

#include <vector>

#include "cosserat_cable/fit/fit_problem.h"
#include "screening.h"
#include "trial.h"

namespace cosserat_cable {

/// Trials of the cause `contact` in clamp a's frame, each in the way of some part of the motion
/// that the model at a point makes: faint ones, and `whole` ones if asked for.
std::vector<Trial> TrialObstacles(const FitProblem& problem, const FitPoint& at, bool whole);

/// A whole one and others beside it, all its free numbers less and more by `step` of some degrees
/// or hundredths of the cable's length.
std::vector<Trial> ObstaclesAround(const Trial& whole, double step, double length);

/// Of a whole one and what promises more around it, the best: step by step, by ever smaller steps.
Screened BestObstacleNear(const FitProblem& problem, const FitPoint& at, const Screened& whole,
                          double step, double length);

}  // namespace cosserat_cable
