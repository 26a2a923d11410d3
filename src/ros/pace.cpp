#include "pace.h"

#include <algorithm>

namespace cosserat_cable {
namespace {

// The motion curve alone keeps the cables some tens of milliseconds behind; a viewer notices half a
// second.
constexpr double kLate = 0.5;    // [s]
constexpr double kOnTime = 0.2;  // [s]
// At the start a second of samples has piled up, which is caught up with at once: no reason to
// worry.
constexpr std::chrono::seconds kPatience{2};

}  // namespace

void Pace::Advanced(double simulated, double busy) {
  simulated_ += simulated;
  busy_ += busy;
}

void Pace::Delivered(double latency, Clock::time_point now) {
  worst_ = std::max(worst_, latency);
  if (latency < kOnTime) {
    late_since_.reset();
    behind_ = false;
  } else if (latency > kLate && !late_since_) {
    late_since_ = now;
  }
  if (late_since_ && now - *late_since_ > kPatience) behind_ = true;
}

Pace::Report Pace::Take() {
  const Report report{busy_ > 0 ? simulated_ / busy_ : 0.0, worst_};
  simulated_ = busy_ = worst_ = 0;
  return report;
}

}  // namespace cosserat_cable
