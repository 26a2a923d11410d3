#include "cosserat_cable/ros/warnings.h"

#include <utility>

namespace cosserat_cable {

void Warnings::Count(const std::string& kind, const std::string& detail) {
  if (++counts_[kind] == 1) fresh_.push_back(detail.empty() ? kind : kind + ": " + detail);
}

std::vector<std::string> Warnings::TakeNew() { return std::exchange(fresh_, {}); }

}  // namespace cosserat_cable
