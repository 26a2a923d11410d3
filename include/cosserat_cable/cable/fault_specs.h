// The ranges of faults' numbers, for their reader and the registry of parameters.
#pragma once

#include "cosserat_cable/input/number_spec.h"

namespace cosserat_cable {

inline NumberSpec ClockScaleSpec() { return NumberSpec::AtLeast(-0.5, "").AtMost(1); }
inline NumberSpec ClockDelaySpec() {
  return NumberSpec::AtLeast(-1e3, "s").AtMost(1e3).Hint("is it in ms?");
}
inline NumberSpec SensorScaleSpec() { return NumberSpec::Above(0, "").AtMost(1e4); }
/// A component of a rotation vector: at most half a turn.
inline NumberSpec TiltSpec() {
  return NumberSpec::AtLeast(-3.2, "rad").AtMost(3.2).Hint("is it in degrees?");
}
inline NumberSpec TimeConstantSpec() {
  return NumberSpec::AtLeast(0, "s").AtMost(10).Hint(
      "is it a frequency? The time constant is 1/(2 pi frequency)");
}
inline NumberSpec FrequencySpec() { return NumberSpec::Above(0, "Hz").AtMost(1e6); }
inline NumberSpec AmplitudeSpec() { return NumberSpec::AtLeast(-100, "").AtMost(100); }
/// A phase is a shift in time, of less than a period.
inline NumberSpec PhaseSpec() {
  return NumberSpec::AtLeast(-6.3, "rad").AtMost(6.3).Hint("is it in degrees?");
}
inline NumberSpec BracketDampingSpec() { return NumberSpec::AtLeast(0, "").AtMost(10); }

}  // namespace cosserat_cable
