// What went wrong without stopping anything: counted by kind, said once.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cosserat_cable {

class Warnings {
 public:
  /// Counts one of this kind; the first of a kind is kept for TakeNew with `detail` appended.
  void Count(const std::string& kind, const std::string& detail = "");

  const std::map<std::string, std::uint64_t>& counts() const { return counts_; }
  /// A sentence for each kind: how many there were, and the first one's detail.
  std::vector<std::string> Sentences() const;
  /// Sentences for the kinds that are new since the last call.
  std::vector<std::string> TakeNew();

 private:
  std::map<std::string, std::uint64_t> counts_;
  std::map<std::string, std::string> details_;  // of the first of each kind
  std::vector<std::string> fresh_;
};

}  // namespace cosserat_cable
