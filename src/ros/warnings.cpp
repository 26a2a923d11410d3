#include "cosserat_cable/ros/warnings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/vehicle/finding.h"

namespace cosserat_cable {
namespace {

// More names say no more.
constexpr std::size_t kMostSubjects = 4;

std::string WithRemedy(const std::string& remedy) { return remedy.empty() ? "" : ": " + remedy; }

}  // namespace

void Warnings::Count(const std::string& kind, const std::string& detail) {
  Event event;
  event.detail = detail;
  Count(kind, event);
}

void Warnings::Count(const std::string& kind, const Event& event) {
  Known& known = known_[kind];
  if (++counts_[kind] == 1) {
    known.first = event;
    fresh_.push_back((event.detail.empty() ? kind : kind + ": " + event.detail) +
                     WithRemedy(event.remedy));
  }
  if (known.largest_at == 0 || std::abs(event.size) > std::abs(known.largest)) {
    known.largest = event.size;
    known.largest_at = event.stamp;
  }
  const bool is_new = std::find(known.subjects.begin(), known.subjects.end(), event.subject) ==
                      known.subjects.end();
  if (is_new && !event.subject.empty() && known.subjects.size() <= kMostSubjects)
    known.subjects.push_back(event.subject);
}

std::string Warnings::Sentence(const std::string& kind, std::int64_t start) const {
  const Known& known = known_.at(kind);
  std::string text = std::to_string(counts_.at(kind));
  if (!known.first.detail.empty()) text += " (first: " + known.first.detail + ")";
  if (known.first.stamp != 0) text += ", at " + StampText(known.first.stamp, start);
  if (known.largest != 0) {
    text += ", by up to " + FormatRounded(known.largest) + " " + known.first.unit;
    if (known.largest_at != known.first.stamp) text += " at " + StampText(known.largest_at, start);
  }
  if (known.subjects.size() > 1) {
    text += ", of ";
    for (std::size_t i = 0; i < std::min(known.subjects.size(), kMostSubjects); ++i)
      text += (i > 0 ? ", " : "") + known.subjects[i];
    if (known.subjects.size() > kMostSubjects) text += " and others";
  }
  return text + WithRemedy(known.first.remedy);
}

std::vector<std::string> Warnings::Sentences(std::int64_t start) const {
  std::vector<std::string> sentences;
  for (const auto& [kind, count] : counts_)
    sentences.push_back(kind + ": " + Sentence(kind, start));
  return sentences;
}

std::vector<std::string> Warnings::TakeNew() { return std::exchange(fresh_, {}); }

}  // namespace cosserat_cable
