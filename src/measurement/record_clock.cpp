#include "record_clock.h"

namespace cosserat_cable {

std::vector<double> MotionTimes(const std::vector<double>& t_record,
                                const std::optional<ClockFault>& fault) {
  std::vector<double> t_motion = t_record;
  if (!fault) return t_motion;
  for (double& t : t_motion) t = (t - fault->delay) / (1 + fault->scale);
  return t_motion;
}

}  // namespace cosserat_cable
