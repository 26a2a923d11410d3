// The laws of one end of a rod, as a value: copying a rod copies their internal variables.
#pragma once

#include <memory>
#include <vector>

#include "cosserat_cable/rod/end_law.h"

namespace cosserat_cable::rod {

class EndLaws {
 public:
  explicit EndLaws(const std::vector<std::shared_ptr<const EndLaw>>& prototypes) {
    for (const auto& prototype : prototypes) laws_.push_back(prototype->Clone());
  }
  EndLaws(const EndLaws& other) {
    for (const auto& law : other.laws_) laws_.push_back(law->Clone());
  }
  EndLaws(EndLaws&&) noexcept = default;
  EndLaws& operator=(EndLaws&&) noexcept = default;

  bool empty() const { return laws_.empty(); }
  template <class Act>
  void ForEach(const Act& act) {
    for (auto& law : laws_) act(law.get());
  }
  /// The sum of `of(law)` over all, from `sum`.
  template <class Value, class Of>
  Value Sum(Value sum, const Of& of) const {
    for (const auto& law : laws_) sum += of(*law);
    return sum;
  }

 private:
  std::vector<std::unique_ptr<EndLaw>> laws_;
};

}  // namespace cosserat_cable::rod
