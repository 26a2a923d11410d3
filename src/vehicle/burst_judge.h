// Whether an edge's stamps come in bursts: several at nearly one time, then none for long. Such
// stamps are of sending, not of measurement.
#pragma once

#include <cstdint>

#include "cosserat_cable/vehicle/finding.h"

namespace cosserat_cable {

class BurstJudge {
 public:
  /// @pre stamps [ns] increase
  void Add(std::int64_t stamp);
  void Restart() { has_last_ = false; }
  bool IsBursts() const;
  /// @pre IsBursts()
  Finding Report() const;

 private:
  bool has_last_ = false;
  std::int64_t last_ = 0;
  std::uint64_t intervals_ = 0, close_ = 0;
  std::int64_t span_ = 0;                  // of all intervals [ns]
  std::int64_t length_ = 0, longest_ = 0;  // of the burst at hand, and of the longest one [ns]
  std::uint64_t in_a_row_ = 0;             // samples of the burst at hand
  std::uint64_t bursts_ = 0, in_bursts_ = 0;
  std::int64_t first_ = 0;
  std::int64_t between_ = 0, pauses_ = 0;  // the long intervals together, and how many
};

}  // namespace cosserat_cable
