// `clock`: the record's time is scaled or shifted against the motion's (measurement/record_clock).
#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {

Cause ClockCause() {
  Cause cause;
  cause.name = "clock";
  cause.words = "a clock that runs wrong or late";
  cause.hypotheses = {{{{{"faults.clock.scale"}}, {{"faults.clock.delay"}}}}};
  return cause;
}

}  // namespace cosserat_cable
