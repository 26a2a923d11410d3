// Whether the live node keeps up with the clock.
#pragma once

#include <chrono>
#include <optional>

namespace cosserat_cable {

class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// What was simulated [s], and what that took [s of the wall's clock].
  void Advanced(double simulated, double busy);
  /// How old [s of the node's clock] telemetry was when it was handed out, at `now`.
  void Delivered(double latency, Clock::time_point now);

  /// It has been late for so long that something has to be left out; until it is on time again.
  bool behind() const { return behind_; }

  struct Report {
    double real_time_factor =
        0;                     ///< simulated over busy time: what the machine could do; 0: unknown
    double worst_latency = 0;  ///< [s]
  };
  /// Since it was last asked.
  Report Take();

 private:
  double simulated_ = 0, busy_ = 0, worst_ = 0;
  std::optional<Clock::time_point> late_since_;
  bool behind_ = false;
};

}  // namespace cosserat_cable
