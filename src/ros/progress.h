// How far a run is: a bar with the time left on a terminal, now and then a plain line otherwise.
#pragma once

#include <chrono>

namespace cosserat_cable {

class Progress {
 public:
  /// `total`: what is to be done [s of simulated time].
  explicit Progress(double total);
  ~Progress();

  void Update(double done);

 private:
  using Clock = std::chrono::steady_clock;
  double total_;
  bool terminal_;
  Clock::time_point start_, last_;
  int last_tenth_ = 0;
};

}  // namespace cosserat_cable
