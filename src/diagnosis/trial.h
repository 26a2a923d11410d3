// A hypothesis on a set: its numbers at some size, and the set in which they are free.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/causes/cause.h"
#include "cosserat_cable/measurement/measurement_set.h"
#include "motion_scales.h"

namespace cosserat_cable {

/// One component of a hypothesis: what grows together from nothing.
struct TrialComponent {
  std::vector<HypothesisNumber> numbers;  ///< `times` in the numbers' own units
  bool one_sided = false;                 ///< none of them can be negative
  double size = 1;                        ///< factor on all sizes, found by their effect

  /// Whether it can grow from nothing; otherwise it is there or not.
  bool grows() const;
  /// Whether something of it acts without its sizes, too.
  bool acts_beside() const;
  /// Values by path at `size` times `part`.
  std::vector<std::pair<std::string, double>> At(double part = 1) const;
};

/// A hypothesis of a cause, with all numbers in their units.
struct Trial {
  std::string cause;
  std::vector<TrialComponent> components;
  std::vector<std::string> channels;  ///< that a sensor's fault concerns; none: all

  std::vector<std::string> FreePaths() const;
  /// All values at the sizes of the components.
  std::map<std::string, double> Values() const;
  /// Whether both can be at work at once: other causes, or one cause in ways that share no number.
  bool CanBeBeside(const Trial& other) const;
  /// Whether its numbers at these values are all sizes below the cause's least.
  bool IsFaint(const std::function<double(const std::string& path)>& value_of) const;
};

/// Their causes, in order, each once.
std::vector<std::string> CausesOf(const std::vector<Trial>& trials);

/// The hypotheses of a cause from where a simpler one was found.
std::vector<Trial> TrialsFromSimpler(const Cause& cause, const MotionScales& scales);

/// All hypotheses of all causes that the set does not already say something about.
std::vector<Trial> AllTrials(const MeasurementSet& set, const MotionScales& scales);

/// The set with the trials' numbers at their start, the free ones among what is uncertain.
MeasurementSet WithTrials(const MeasurementSet& set, const std::vector<Trial>& trials);

}  // namespace cosserat_cable
