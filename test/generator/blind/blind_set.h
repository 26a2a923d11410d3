#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "../measurement_set.h"

namespace cosserat_cable::generator {

/// What is asked for.
struct BlindPlan {
  std::string suite;
  std::string effect;  ///< empty: drawn
  std::uint64_t seed = 1;
  double snr = 40.0;      ///< [dB]
  double strength = 5.0;  ///< in times the noise, after recalibration
};

/// What an honest diagnosis says.
struct Expectation {
  std::string verdict;                    ///< none, named, ambiguous, unexplained
  std::vector<std::string> causes;        ///< all of them named, or among those that are possible
  std::vector<std::string> also;          ///< may be named beside them
  std::vector<std::string> tolerated;     ///< other verdicts that are not wrong
  std::vector<std::string> undetermined;  ///< parameters that must not get a number
};

/// A measurement set to be diagnosed, and everything that the diagnosis must not see.
struct BlindSet {
  BlindPlan plan;
  std::string label;  ///< what is at work
  MeasurementSet seen, unseen;
  double reached = 0.0;  ///< strength
  /// Chi by which the data tell the cause from its look-alike (of twins; 0: not asked).
  double separation = 0.0;
  std::vector<double> strengths;  ///< of each experiment
  double correlation = 0.0;       ///< of the noise, between neighbours
  bool told = false;              ///< whether the set says how large the noise is
  Expectation expected;
};

/// Names of the suites.
std::vector<std::string> blindSuites();

/// Throws std::invalid_argument where there is no such suite or effect.
BlindSet blindSet(const BlindPlan& plan);

/// Writes the set to folder/set, the record that is not shown to folder/unseen, and
/// folder/truth.json.
void writeBlind(const BlindSet& set, const std::string& folder);

}  // namespace cosserat_cable::generator
