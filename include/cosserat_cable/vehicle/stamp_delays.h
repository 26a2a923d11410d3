// How long after its stamp a sample was recorded, usually: what tells one clock from another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cosserat_cable {

/// Keeps a thousand delays at most, evenly chosen from all samples.
class StampDelays {
 public:
  /// Stamp and time of recording [ns].
  void Add(std::int64_t stamp, std::int64_t recorded);
  std::uint64_t count() const { return count_; }
  std::int64_t first() const { return delays_.empty() ? 0 : delays_.front(); }  ///< [ns]
  std::int64_t Median() const;  ///< [ns]; 0 where there are none
  /// From the first eighth of the samples to the last one [ns]; 0 where there are few.
  std::int64_t Change() const;

 private:
  std::vector<std::int64_t> delays_;
  std::uint64_t count_ = 0, stride_ = 1;
};

}  // namespace cosserat_cable
