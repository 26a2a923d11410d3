#include "cosserat_cable/vehicle/stamp_delays.h"

#include <algorithm>

namespace cosserat_cable {
namespace {

constexpr std::size_t kMost = 1024;

}  // namespace

void StampDelays::Add(std::int64_t stamp, std::int64_t recorded) {
  if (count_++ % stride_ != 0) return;
  delays_.push_back(recorded - stamp);
  if (delays_.size() < kMost) return;
  for (std::size_t i = 0; 2 * i < delays_.size(); ++i) delays_[i] = delays_[2 * i];
  delays_.resize(delays_.size() / 2);
  stride_ *= 2;
}

std::int64_t StampDelays::Median() const {
  if (delays_.empty()) return 0;
  std::vector<std::int64_t> sorted = delays_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

}  // namespace cosserat_cable
