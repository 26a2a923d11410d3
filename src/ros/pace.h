// Whether the live node keeps up with the clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace cosserat_cable {

class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// The simulation goes on from `simulated` [ns].
  void Begin(std::int64_t simulated, Clock::time_point now);
  /// It has come that far without a rest.
  void Reached(std::int64_t simulated, Clock::time_point now);
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
  std::int64_t at_ = 0;  // [ns]
  Clock::time_point at_time_;
  double simulated_ = 0, busy_ = 0, worst_ = 0;
  std::optional<Clock::time_point> late_since_;
  bool behind_ = false;
};

}  // namespace cosserat_cable
