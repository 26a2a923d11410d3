#pragma once

#include <cstdint>

#include "measurement_set.h"

namespace cosserat_cable::generator {

/// Two ring-downs and torsion at three or four lengths, of a random but possible cable.
MeasurementSet randomSet(std::uint64_t seed, double snr);

/// A soft wire that hangs down and swings a little.
MeasurementSet wireSet(std::uint64_t seed, double snr);

/// One or two ring-downs of a second or two, so small that a fit takes seconds.
struct RingdownPlan {
  /// The sensor is switched on while the cable swings: within the first period.
  bool unknown_start = false;
};
MeasurementSet ringdownSet(std::uint64_t seed, double snr, const RingdownPlan& plan);

/// Records of torsion: so many lengths, `repeats` of each.
struct TorsionPlan {
  int lengths = 5;
  int repeats = 3;
  double longest = 0.5;  ///< [m]
  /// Of D_E from record to record: standard deviation in parts of its mean. A clamp that is
  /// fastened anew is not the same clamp.
  double scatter = 0.0;
};
MeasurementSet torsionSeries(std::uint64_t seed, double snr, const TorsionPlan& plan);

/// Six records of three seconds: three ring-downs, three lengths of torsion.
MeasurementSet sixRecords(std::uint64_t seed, double snr);

}  // namespace cosserat_cable::generator
