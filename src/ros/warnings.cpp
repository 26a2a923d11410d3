#include "cosserat_cable/ros/warnings.h"

#include <utility>

namespace cosserat_cable {

void Warnings::Count(const std::string& kind, const std::string& detail) {
  if (++counts_[kind] > 1) return;
  details_[kind] = detail;
  fresh_.push_back(detail.empty() ? kind : kind + ": " + detail);
}

std::vector<std::string> Warnings::Sentences() const {
  std::vector<std::string> sentences;
  for (const auto& [kind, count] : counts_) {
    const std::string& detail = details_.at(kind);
    sentences.push_back(kind + ": " + std::to_string(count) +
                        (detail.empty() ? "" : " (first: " + detail + ")"));
  }
  return sentences;
}

std::vector<std::string> Warnings::TakeNew() { return std::exchange(fresh_, {}); }

}  // namespace cosserat_cable
