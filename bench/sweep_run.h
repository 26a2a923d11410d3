// One run of a code through the sweep: what it gave, and what it cost.
#pragma once

#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include "apex_amplitude.h"

namespace cosserat_cable::bench {

/// Amplitudes [m] that a run is held to: of the apex in space, and of its sway, which is against
/// the cable's own end.
struct Target {
  std::vector<double> apex, sway;
};

struct SweepRun {
  std::string outcome = "done";    ///< or why there is no result
  double seconds = 0;              ///< of the steps alone
  std::vector<double> apex, sway;  ///< amplitudes [m]

  bool done() const { return outcome == "done"; }
};

/// Sweeps a system at rest until `end` [s]; gives up where it is going to take more than `budget`
/// [s].
template <class System>
SweepRun RunSweep(System system, double dt, double end,
                  double budget = std::numeric_limits<double>::infinity()) {
  using Clock = std::chrono::steady_clock;
  constexpr int kBetweenLooks = 500;  // steps
  const int steps = static_cast<int>(std::lround(end / dt));
  SweepRun run;
  Track apex{dt, {}}, sway{dt, {}};
  apex.x.reserve(steps);
  sway.x.reserve(steps);
  if (!system.Start()) {
    run.outcome = "unstable";
    return run;
  }
  const auto begin = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  for (int k = 1; k <= steps; ++k) {
    if (!system.Step(SweptArch::Shift(k * dt))) {
      run.outcome = "unstable";
      return run;
    }
    apex.x.push_back(system.Apex());
    sway.x.push_back(system.Apex() - system.End());
    if (k % kBetweenLooks == 0 && elapsed() / k * steps > budget) {
      run.outcome = "too slow";
      return run;
    }
  }
  run.seconds = elapsed();
  run.apex = Amplitudes(apex, end);
  run.sway = Amplitudes(sway, end);
  return run;
}

}  // namespace cosserat_cable::bench
