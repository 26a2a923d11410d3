// What each hypothesis could explain of a misfit, to first order: it orders the work, and decides
// nothing.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "goodness.h"
#include "trial.h"

namespace cosserat_cable {

struct Screened {
  Trial trial;      ///< components that no record shows are gone; sizes as their effect asks
  double drop = 0;  ///< of the sum of squares, as far as derivatives tell [noise variances]
  /// By component: what it does to the weighted records, its part in what the point's own unknowns
  /// can do as well, and its product with what the point leaves.
  std::vector<Eigen::VectorXd> effects, parts;
  std::vector<double> gradient;
};

/// Two hypotheses of different causes, by their places, and the drop of both together.
struct ScreenedPair {
  std::size_t first = 0, second = 0;
  double drop = 0;
};

/// One simulation per component at the point, its size such that it moves the records by half of
/// their noise, and the score test of the components together: their derivatives less what the
/// point's own unknowns can do as well. Hypotheses that cannot be simulated or that no record shows
/// are left out. The most promising come first. `failures`, where it is given: by cause, why one
/// that could not be simulated could not.
std::vector<Screened> Screen(const FitProblem& problem, const FitPoint& at,
                             std::vector<Trial> trials,
                             std::map<std::string, std::string>* failures = nullptr);

/// The best pair of each two causes; the most promising come first.
std::vector<ScreenedPair> ScreenPairs(const std::vector<Screened>& screened);

}  // namespace cosserat_cable
