// `base_motion`: a clamp moves otherwise than its motion file or pose says
// (measurement/base_motion).
#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {

Cause BaseMotionCause() {
  using Role = HypothesisNumber::Role;
  constexpr double kLeast = 1e-4;
  Cause cause;
  cause.least = kLeast;
  cause.name = "base_motion";
  cause.words = "a clamp that moves otherwise than its file says";
  for (const std::string clamp : {"faults.base_motion.a.", "faults.base_motion.b."}) {
    cause.hypotheses.push_back({{{{clamp + "amplitude"}}, {{clamp + "phase"}}}});
    cause.hypotheses.push_back(
        {{{{clamp + "bracket.frequency", Role::kInverse, 10, NumberScale::kFrequency},
           {clamp + "bracket.damping", Role::kHeld, 0.05, NumberScale::kOne}}}});
    cause.hypotheses.push_back(
        {{{{clamp + "tilt[0]"}}, {{clamp + "tilt[1]"}}, {{clamp + "tilt[2]"}}}});
  }
  // One source of both motions errs in both.
  cause.hypotheses.push_back({{{{"faults.base_motion.a.amplitude"}},
                               {{"faults.base_motion.b.amplitude"}},
                               {{"faults.base_motion.a.phase"}},
                               {{"faults.base_motion.b.phase"}}}});
  return cause;
}

}  // namespace cosserat_cable
