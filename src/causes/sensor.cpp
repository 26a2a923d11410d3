// `sensor`: what a group of channels shows is scaled, tilted or low-passed (measurement/sensor).
#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {

Cause SensorCause() {
  using Role = HypothesisNumber::Role;
  constexpr double kLeast = 1e-4;
  Cause cause;
  cause.least = kLeast;
  cause.name = "sensor";
  cause.words = "a sensor that is scaled, tilted or slow";
  cause.hypotheses = {{{{{"faults.sensor[0].scale"}}}},
                      {{{{"faults.sensor[0].tilt[0]"}},
                        {{"faults.sensor[0].tilt[1]"}},
                        {{"faults.sensor[0].tilt[2]"}}}},
                      {{{{"faults.sensor[0].low_pass", Role::kSize, 0.02, NumberScale::kPeriod}}}}};
  return cause;
}

}  // namespace cosserat_cable
