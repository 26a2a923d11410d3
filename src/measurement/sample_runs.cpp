#include "cosserat_cable/measurement/sample_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cosserat_cable {
namespace {

constexpr Eigen::Index kFrozen = 10;
constexpr Eigen::Index kClipped = 3;
constexpr Eigen::Index kClippedAlone = 5;
// In units of the resolution: the last step before the limit of a signal that ran into it.
constexpr double kJump = 2;

using Values = Eigen::Ref<const Eigen::VectorXd>;

// All maximal runs of equal samples, single ones among them.
std::vector<SampleRun> Runs(const Values& values) {
  std::vector<SampleRun> runs;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (runs.empty() || values[i] != values[i - 1]) runs.push_back({i, 0});
    ++runs.back().count;
  }
  return runs;
}

// How many samples in a row one value of the sensor has: more than one where it is logged faster
// than it measures.
Eigen::Index TypicalCount(const std::vector<SampleRun>& runs) {
  std::vector<Eigen::Index> counts;
  for (const SampleRun& run : runs) counts.push_back(run.count);
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  return *middle;
}

// The smallest step that the signal makes.
double Resolution(const Values& values) {
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 1; i < values.size(); ++i) {
    const double step = std::abs(values[i] - values[i - 1]);
    if (step > 0) smallest = std::min(smallest, step);
  }
  return smallest;
}

double LargestStepAround(const Values& values, const SampleRun& run) {
  const Eigen::Index after = run.first + run.count;
  double step = 0;
  if (run.first > 0) step = std::abs(values[run.first] - values[run.first - 1]);
  if (after < values.size()) step = std::max(step, std::abs(values[after] - values[after - 1]));
  return step;
}

}  // namespace

std::vector<SampleRun> FrozenRuns(const Values& values) {
  std::vector<SampleRun> frozen;
  if (values.size() == 0) return frozen;
  const std::vector<SampleRun> runs = Runs(values);
  const Eigen::Index typical = TypicalCount(runs);
  Eigen::Index steps = values.size() - 1;
  for (const SampleRun& run : runs) {
    if (run.count < kFrozen * typical) continue;
    frozen.push_back(run);
    steps -= run.count - 1;
  }
  const auto changes = static_cast<Eigen::Index>(runs.size()) - 1;
  const bool moves = steps >= kFrozen && 2 * typical * changes > steps;
  return moves ? frozen : std::vector<SampleRun>();
}

std::vector<SampleRun> ClippedRuns(const Values& values) {
  std::vector<SampleRun> clipped;
  if (values.size() == 0 || values.maxCoeff() == values.minCoeff()) return clipped;
  const double most = values.maxCoeff(), least = values.minCoeff();
  const double resolution = Resolution(values);
  const std::vector<SampleRun> runs = Runs(values);
  const Eigen::Index typical = TypicalCount(runs);
  Eigen::Index longest = 0;
  for (const SampleRun& run : runs) {
    const double value = values[run.first];
    if (run.count < kClipped * typical || (value != most && value != least)) continue;
    if (LargestStepAround(values, run) <= kJump * resolution) continue;
    clipped.push_back(run);
    longest = std::max(longest, run.count);
  }
  const bool certain = clipped.size() > 1 || longest >= kClippedAlone * typical;
  return certain ? clipped : std::vector<SampleRun>();
}

}  // namespace cosserat_cable
