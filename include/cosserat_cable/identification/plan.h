// What to measure next: how well a parameter would be known from rigs like those of a set, at other
// lengths, with other discs, more often.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cosserat_cable/identification/estimation.h"

namespace cosserat_cable {

struct PlanOptions {
  std::string target;     ///< the parameter; empty: the one that is known worst
  double accuracy = 0.1;  ///< half of its 95 % interval, relative
  double longest = 0;     ///< what the laboratory has room for [m]; 0: as long as the set's longest
  double shortest = 0;    ///< [m]; 0: as short as the set's shortest, or half of the longest
  int most_repeats = 50;  ///< of each length
};

/// One way of measuring: each of the lengths `repeats` times.
struct PlanCandidate {
  std::string like;             ///< the experiment of the set that is repeated
  std::vector<double> lengths;  ///< [m]
  double inertia = 0;           ///< of the disc [kg m^2]; 0: no disc
  int repeats = 1;
  double half_width = 0;  ///< relative, of the target's 95 % interval
  int records() const { return repeats * static_cast<int>(lengths.size()); }
};

struct Plan {
  std::string target;
  double accuracy = 0;
  double half_width_now =
      0;  ///< of the set itself; infinite where it does not determine the target
  std::vector<PlanCandidate>
      candidates;        ///< the fewest records first; those that do not reach it last
  bool reached = false;  ///< whether the first candidate does
  std::string message;   ///< why there is none
};

/// From the Fisher information of simulated records, with the parameters as they were estimated and
/// the noise of the set's channels. What was found to differ between the set's records differs
/// between the planned ones as much; other specimens are not in it.
Plan MakePlan(const MeasurementSet& set, const Estimation& estimation, const PlanOptions& options,
              const EstimationProgress& progress);

}  // namespace cosserat_cable
