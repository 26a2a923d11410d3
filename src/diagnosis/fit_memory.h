// What the fits of a diagnosis have found so far, in a file: one that was ended goes on from there.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "cosserat_cable/fit/fit_problem.h"

namespace cosserat_cable {

class FitMemory {
 public:
  struct Fit {
    bool at_minimum = false;
    std::map<std::string, double> values;  ///< of the unknowns
  };

  /// Without a file it remembers nothing. A file of another set is forgotten.
  FitMemory(const std::string& file, const MeasurementSet& set);

  /// How many fits the file held at the beginning.
  int begun_with() const { return begun_with_; }
  /// Null where this fit has not been made.
  const Fit* Find(const std::string& key) const;
  /// @throws std::runtime_error where the file cannot be written
  void Add(const std::string& key, const FitPoint& point);
  /// The work is done: nothing is to be gone on with.
  void Forget();

 private:
  std::string file_, set_;
  std::map<std::string, Fit> fits_;
  int begun_with_ = 0;
};

}  // namespace cosserat_cable
