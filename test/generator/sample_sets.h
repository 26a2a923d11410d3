#pragma once

#include <cstdint>

#include "measurement_set.h"

namespace cosserat_cable::generator {

/// What is switched on in a set, and how large.
struct EffectPlan {
  std::vector<std::string> names;        ///< `none` counts for nothing
  double size = 1.0;                     ///< times the effects' defaults
  std::vector<std::string> assignments;  ///< KEY=VALUE on top of that
};

/// Gives the experiments the plan's effects, in sizes that suit them; says so in the set.
void applyEffects(const EffectPlan& plan, std::vector<Experiment>* experiments,
                  MeasurementSet* set);

/// Two ring-downs and torsion at three or four lengths, of a random but possible cable.
MeasurementSet randomSet(std::uint64_t seed, double snr, const EffectPlan& effects = {});

/// A soft wire that hangs down and swings a little.
MeasurementSet wireSet(std::uint64_t seed, double snr, const EffectPlan& effects = {});

/// One or two ring-downs of a second or two, so small that a fit takes seconds.
struct RingdownPlan {
  /// The sensor is switched on while the cable swings: within the first period.
  bool unknown_start = false;
};
MeasurementSet ringdownSet(std::uint64_t seed, double snr, const RingdownPlan& plan,
                           const EffectPlan& effects = {});

/// Records of torsion: so many lengths, `repeats` of each.
struct TorsionPlan {
  int lengths = 5;
  int repeats = 3;
  double longest = 0.5;  ///< [m]
  /// Of D_E from record to record: standard deviation in parts of its mean. A clamp that is
  /// fastened anew is not the same clamp.
  double scatter = 0.0;
};
MeasurementSet torsionSeries(std::uint64_t seed, double snr, const TorsionPlan& plan,
                             const EffectPlan& effects = {});

/// Six records of three seconds: three ring-downs, three lengths of torsion.
MeasurementSet sixRecords(std::uint64_t seed, double snr, const EffectPlan& effects = {});

}  // namespace cosserat_cable::generator
