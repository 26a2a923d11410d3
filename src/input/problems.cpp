#include "cosserat_cable/input/problems.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

namespace cosserat_cable {
namespace {

std::string LowerCase(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

// A key or a name that is longer was not mistyped.
constexpr std::size_t kLongestWord = 200;

// Edits (insertion, deletion, substitution, swap of neighbours) that turn `a` into `b`: the
// restricted Damerau-Levenshtein distance. More than `most` where it is more.
std::size_t EditDistance(const std::string& a, const std::string& b, std::size_t most) {
  if (a.size() > b.size() + most || b.size() > a.size() + most) return most + 1;
  // Rows of the table: two ago, the last, this one.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    std::size_t fewest = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
      fewest = std::min(fewest, row[j]);
    }
    // A swap comes from two rows ago, which had no fewer than the last one less one.
    if (fewest > most + 1) return most + 1;
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::string Problem::ToString() const {
  std::string text = file;
  if (line > 0) text += (text.empty() ? "line " : ":") + std::to_string(line);
  if (!key.empty()) text += (text.empty() ? "" : ": ") + key;
  return text + (text.empty() ? "" : ": ") + message;
}

void Problems::Add(std::string file, int line, std::string key, std::string message) {
  problems_.push_back({std::move(file), line, std::move(key), std::move(message)});
}

void Problems::Append(const Problems& others) {
  problems_.insert(problems_.end(), others.problems_.begin(), others.problems_.end());
}

void Problems::SortByLine() {
  std::map<std::string, std::size_t> rank;  // files in the order in which they were met
  for (const Problem& problem : problems_) rank.emplace(problem.file, rank.size());
  std::stable_sort(problems_.begin(), problems_.end(), [&](const Problem& a, const Problem& b) {
    return std::make_pair(rank.at(a.file), a.line) < std::make_pair(rank.at(b.file), b.line);
  });
  std::set<std::string> said;
  const auto repeats = [&said](const Problem& problem) {
    return !said.insert(problem.ToString()).second;
  };
  problems_.erase(std::remove_if(problems_.begin(), problems_.end(), repeats), problems_.end());
}

std::string Problems::ToString() const {
  std::string text;
  for (const Problem& problem : problems_) text += problem.ToString() + "\n";
  return text;
}

std::string NearestWord(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > kLongestWord) return "";
  const std::string wanted = LowerCase(word);
  std::string nearest;
  std::size_t fewest = 0;
  for (const std::string& candidate : candidates) {
    // A third of the longer word: a typo or two, not another word. Two-letter keys need one edit.
    const std::size_t allowed =
        std::max<std::size_t>(1, std::max(word.size(), candidate.size()) / 3);
    const std::size_t edits = EditDistance(wanted, LowerCase(candidate), allowed);
    // One edit turns any one-letter word into any other: that says nothing about what was meant.
    const bool meant =
        edits == 0 || (edits <= allowed && edits < std::min(word.size(), candidate.size()));
    if (meant && (nearest.empty() || edits < fewest)) {
      nearest = candidate;
      fewest = edits;
    }
  }
  return nearest;
}

}  // namespace cosserat_cable
