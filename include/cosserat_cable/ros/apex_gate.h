// Bounds on a cable's telemetry, for tests of any package (see src/apps/apex_check.cpp).
#pragma once

#include <cosserat_cable/ApexTelemetry.h>

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// One set of bounds over one window. All are inclusive; NaN: not asked for.
struct ApexBounds {
  std::string name;
  double start = 0;  ///< of the window, after the first stamp [s]
  double end = std::numeric_limits<double>::infinity();  ///< [s]
  char axis = 'p';  ///< of peak to peak: x, y, z of the reference link, or p, the principal axis
  double peak_to_peak_min = kNone, peak_to_peak_max = kNone;  ///< of the apex's position [m]
  double min_clearance = kNone;                               ///< [m]
  double max_penetration = kNone;     ///< negative clearance at most so deep [m]
  double max_curvature = kNone;       ///< [1/m]
  double max_contact_force = kNone;   ///< [N]
  double max_interval = kNone;        ///< between two messages, and to the window's ends [s]
  double max_rms_difference = kNone;  ///< of positions from the comparison's, at equal stamps,
                                      ///< which must have them all [m]

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

/// What was measured, and each bound that does not hold.
struct ApexVerdict {
  std::vector<std::string> measured;
  std::vector<std::string> violations;
};

/// Extent of the positions along `axis` as in ApexBounds [m]. Peaks between samples are met by the
/// cubics through positions and velocities: 200 Hz is coarse for 40 Hz.
double PeakToPeak(const std::vector<ApexTelemetry>& messages, char axis);

/// Judges messages in the order of their stamps. These are violations, too: no message in the
/// window, telemetry that ends long before it or is not finite, no bound at all, and a bound on
/// clearance or contact of a cable that has nothing to touch.
/// @param comparison another run's messages, where max_rms_difference is asked for
ApexVerdict Judge(const std::vector<ApexTelemetry>& messages,
                  const std::vector<ApexTelemetry>& comparison, const ApexBounds& bounds);

/// A cable's telemetry out of a bag; a bag that cannot be read is a problem.
std::vector<ApexTelemetry> ReadApexTelemetry(const std::string& bag, const std::string& cable,
                                             Problems* problems);

}  // namespace cosserat_cable
