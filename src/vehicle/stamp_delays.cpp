#include "cosserat_cable/vehicle/stamp_delays.h"

#include <algorithm>

namespace cosserat_cable {
namespace {

constexpr std::size_t kMost = 1024;

std::int64_t MedianOf(std::vector<std::int64_t> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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
  return delays_.empty() ? 0 : MedianOf({delays_.begin(), delays_.end()});
}

std::int64_t StampDelays::Change() const {
  constexpr std::ptrdiff_t kFewest = 5;
  const std::ptrdiff_t part = static_cast<std::ptrdiff_t>(delays_.size()) / 8;
  if (part < kFewest) return 0;
  return MedianOf({delays_.end() - part, delays_.end()}) -
         MedianOf({delays_.begin(), delays_.begin() + part});
}

}  // namespace cosserat_cable
