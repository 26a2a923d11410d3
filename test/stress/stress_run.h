// Random cables through the simulation, and what became of each.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace cosserat_cable::stress {

enum class End {
  kConverged,
  kNamedFailure,    ///< it stopped, and said why
  kUnnamedFailure,  ///< it stopped without a word
  kNotFinite,       ///< a state or result that is no number
  kPastItsBound,    ///< a step took more iterations than any can
  kNotRun           ///< the run was interrupted before
};

/// What became of one cable.
struct Run {
  std::uint32_t index = 0;
  double EI = 0;         ///< the smaller one [N m^2]
  bool resolved = true;  ///< its elements were short enough for what it carried
  End end = End::kNotRun;
  std::string message;  ///< of a failure, with the time
  int steps = 0;        ///< that converged
  int retried = 0;      ///< of them, in parts
  long iterations = 0;  ///< of all steps
  bool slow() const;    ///< it took ten times as many as a smooth motion does
};

/// Runs `count` of the cables that `seed` makes from number `first` on, in their order. A cable's
/// run depends neither on the others nor on `threads`. `go_on` is told how many are done, from one
/// thread at a time; false ends it.
std::vector<Run> RunCables(std::uint32_t seed, std::uint32_t first, std::uint32_t count,
                           int threads, const std::function<bool(std::uint32_t)>& go_on);

}  // namespace cosserat_cable::stress
