// First stage of a record: the times of its samples, on the motion's own clock.
#pragma once

#include <vector>

#include "cosserat_cable/cable/faults.h"

namespace cosserat_cable {

/// t_motion [s] of samples at t_record, with t_record = (1 + scale) t_motion + delay. Motion files,
/// loads and the start go by t_motion.
std::vector<double> MotionTimes(const std::vector<double>& t_record,
                                const std::optional<ClockFault>& fault);

}  // namespace cosserat_cable
