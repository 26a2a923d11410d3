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

void Pace::Begin(std::int64_t simulated, Clock::time_point now) {
  at_ = simulated;
  at_time_ = now;
}

void Pace::Reached(std::int64_t simulated, Clock::time_point now) {
  // Not where the cables settled anew, which takes time and simulates none.
  if (at_ > 0 && simulated > at_) {
    simulated_ += static_cast<double>(simulated - at_) * 1e-9;
    busy_ += std::chrono::duration<double>(now - at_time_).count();
  }
  Begin(simulated, now);
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
