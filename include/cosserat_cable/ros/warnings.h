// What went wrong without stopping anything: counted by kind, said once.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cosserat_cable {

class Warnings {
 public:
  /// What is known of one of a kind.
  struct Event {
    std::string detail;
    std::string subject;     ///< frame or joint; empty where the kind names it
    std::int64_t stamp = 0;  ///< [ns]; 0: not known
    double size = 0;         ///< 0: none
    const char* unit = "";
    std::string remedy;  ///< of the kind; the first one's is taken
  };

  /// Counts one of this kind; the first of a kind is kept for TakeNew.
  void Count(const std::string& kind, const Event& event);
  void Count(const std::string& kind, const std::string& detail = "");

  const std::map<std::string, std::uint64_t>& counts() const { return counts_; }
  /// A sentence for each kind: how many there were, the first one's detail and time, which frames
  /// or joints have it, the largest size, and the remedy. `start` [ns]: of the recording; 0: not
  /// known.
  std::vector<std::string> Sentences(std::int64_t start = 0) const;
  /// The sentence of one kind, without its name: "51 (first: frame 'x'), at 10.000 s: ...".
  std::string Sentence(const std::string& kind, std::int64_t start = 0) const;
  /// Sentences for the kinds that are new since the last call.
  std::vector<std::string> TakeNew();

 private:
  struct Known {
    Event first;
    std::vector<std::string> subjects;  // the first few
    double largest = 0;
    std::int64_t largest_at = 0;
  };

  std::map<std::string, std::uint64_t> counts_;
  std::map<std::string, Known> known_;
  std::vector<std::string> fresh_;
};

}  // namespace cosserat_cable
