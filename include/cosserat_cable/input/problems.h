// What is wrong with a user's input, collected until all of it has been read.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cosserat_cable {

/// A place in a user's file, kept so that what is found wrong later can still be said there.
struct SourceMark {
  std::string file;
  int line = 0;     ///< from 1; 0 where there is none
  std::string key;  ///< path of the key, e.g. "cables[2].EI"
};

/// One mistake. Prints as "file:line: key: message"; parts that are unknown (line 0, empty key) are
/// left out.
struct Problem {
  std::string file;
  int line = 0;
  std::string key;      ///< path of the key, e.g. "cables[2].EI"
  std::string message;  ///< "got -1, expected a positive number [N m^2]"

  std::string ToString() const;
};

/// Collects every mistake so that a user sees them all at once; a tool exits with 2 if any.
class Problems {
 public:
  void Add(std::string file, int line, std::string key, std::string message);
  void Add(std::string file, std::string message) {
    Add(std::move(file), 0, "", std::move(message));
  }
  void Add(const SourceMark& where, std::string message) {
    Add(where.file, where.line, where.key, std::move(message));
  }
  /// Adds the others behind these.
  void Append(const Problems& others);
  /// Brings the problems of each file into the order of its lines (files, and problems on one line,
  /// keep the order in which they were found) and drops those that only repeat another.
  void SortByLine();

  bool empty() const { return problems_.empty(); }
  const std::vector<Problem>& all() const { return problems_; }
  /// One line each, in the order in which they were found.
  std::string ToString() const;

 private:
  std::vector<Problem> problems_;
};

/// The candidate nearest to `word` by edit distance (insertions, deletions, substitutions, swaps of
/// neighbours; case does not count), or "" where none is near enough to be meant.
std::string NearestWord(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace cosserat_cable
