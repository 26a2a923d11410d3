#pragma once

#include <cstdint>

#include "measurement_set.h"

namespace cosserat_cable::generator {

/// Two ring-downs and torsion at three or four lengths, of a random but possible cable.
MeasurementSet randomSet(std::uint64_t seed, double snr);

/// A soft wire that hangs down and swings a little.
MeasurementSet wireSet(std::uint64_t seed, double snr);

/// Torsion at several lengths, `repeats` times each.
MeasurementSet torsionSeries(std::uint64_t seed, double snr, int lengths, int repeats);

/// Six records of three seconds: three ring-downs, three lengths of torsion.
MeasurementSet sixRecords(std::uint64_t seed, double snr);

}  // namespace cosserat_cable::generator
