// The cheapest setting of a code that is accurate enough.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sweep_run.h"

namespace cosserat_cable::bench {

/// One row of the table.
struct Trial {
  std::string code;  ///< "rod" or "mujoco"
  int elements;
  double dt;                       ///< [s]
  std::string integrator, solver;  ///< MuJoCo's
  SweepRun run;
  double apex_error = 0, sway_error = 0;  ///< largest, relative to the target
};

/// Says what was tried, so that somebody who waits sees it.
using Reporter = std::function<void(const Trial&)>;

struct Grid {
  std::vector<int> elements;  ///< ascending
  std::vector<double> steps;  ///< [s], descending
  double end;                 ///< of the sweep [s]
};

struct MujocoGrid : Grid {
  std::vector<std::string> integrators, solvers;
  double budget;  ///< [s] for one run
};

/// Tries the grid. With a tolerance of the apex' error above 0 it leaves out what cannot be the
/// cheapest within it: what takes longer than the best so far, and steps shorter than one at which
/// the error is that of the elements.
std::vector<Trial> TryRod(const SweptArch& arch, const Target& target, const Grid& grid,
                          const Reporter& report);
std::vector<Trial> TryMujoco(const SweptArch& arch, const Target& target, const MujocoGrid& grid,
                             double tolerance, const Reporter& report);

/// The cheapest with an apex error within the tolerance, also at all shorter steps that were tried;
/// nullptr: none is.
const Trial* Cheapest(const std::vector<Trial>& trials, double tolerance);
/// The one with the smallest apex error; nullptr: none was done.
const Trial* MostAccurate(const std::vector<Trial>& trials);

/// The run of a setting once more.
SweepRun Repeat(const SweptArch& arch, const Trial& trial, double end);

}  // namespace cosserat_cable::bench
