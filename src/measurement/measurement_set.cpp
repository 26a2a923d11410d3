#include "cosserat_cable/measurement/measurement_set.h"

#include <algorithm>
#include <limits>

namespace cosserat_cable {

const char* ToString(Quantity quantity) {
  switch (quantity) {
    case Quantity::kPosition:
      return "position";
    case Quantity::kVelocity:
      return "velocity";
    case Quantity::kAcceleration:
      return "acceleration";
    case Quantity::kAngle:
      return "angle";
    case Quantity::kRate:
      return "rate";
    case Quantity::kForce:
      return "force";
    case Quantity::kMoment:
      return "moment";
  }
  return "";
}

double Experiment::start_time() const {
  double first = std::numeric_limits<double>::infinity();
  for (const EndCondition* end : {&a, &b}) {
    if (end->motion && !end->motion->t.empty()) first = std::min(first, end->motion->t.front());
  }
  return first < std::numeric_limits<double>::infinity() || record.t.empty() ? first
                                                                             : record.t.front();
}

}  // namespace cosserat_cable
