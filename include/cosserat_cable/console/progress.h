// How far a run is: a bar with the time left on a terminal, now and then a plain line otherwise.
#pragma once

#include <chrono>
#include <string>

namespace cosserat_cable {

class Progress {
 public:
  /// `total`: what is to be done, in `unit`.
  Progress(double total, std::string unit);
  ~Progress();

  /// `what`: is going on; may be empty.
  void Update(double done, const std::string& what = "");

 private:
  using Clock = std::chrono::steady_clock;
  double total_;
  std::string unit_;
  bool terminal_;
  Clock::time_point start_, last_;
  int last_tenth_ = 0;
};

}  // namespace cosserat_cable
