#include "step_grid.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// Rounding of a pose that does not move [m], [rad].
constexpr double kStill = 1e-8;
// Of a step: what a displacement may be off a multiple, and what is smaller than one.
constexpr double kOff = 0.05, kSmaller = 0.75;
// Larger multiples say nothing: the step itself is rounded.
constexpr double kLargestMultiple = 16;
// A uniform motion has one step too: on a grid the multiple changes all the time.
constexpr double kChanges = 0.3;
constexpr std::uint64_t kFewest = 3, kFewestChanges = 6;
constexpr double kMostOff = 0.05;  // of all

}  // namespace

void StepGrid::Axis::Add(double d) {
  const double size = std::abs(d);
  if (size > kStill && (step == 0 || size < kSmaller * step)) {
    // What kept to the larger step keeps to this one where that is a multiple of it.
    const double ratio = step / size;
    if (std::abs(ratio - std::round(ratio)) > kOff) {
      off += on;
      on = 0;
    }
    step = size;
  }
  const double ratio = size > kStill ? d / step : 0;
  if (std::abs(ratio) > kLargestMultiple) return;
  const long nearest = std::lround(ratio);
  if (size > kStill) ++(std::abs(ratio - static_cast<double>(nearest)) < kOff ? on : off);
  if (nearest != multiple) ++changes;
  multiple = nearest;
}

bool StepGrid::Axis::IsGrid() const {
  return on >= kFewest && changes >= kFewestChanges &&
         static_cast<double>(changes) > kChanges * static_cast<double>(on) &&
         static_cast<double>(off) < kMostOff * static_cast<double>(on);
}

void StepGrid::Add(const Eigen::Vector3d& d) {
  for (int k = 0; k < 3; ++k) axes_[static_cast<std::size_t>(k)].Add(d[k]);
}

double StepGrid::Step() const {
  double squares = 0;
  for (const Axis& axis : axes_)
    if (axis.IsGrid()) squares += axis.step * axis.step;
  return std::sqrt(squares);
}

double StepGrid::LargestStep() const {
  double largest = 0;
  for (const Axis& axis : axes_)
    if (axis.IsGrid()) largest = std::max(largest, axis.step);
  return largest;
}

double StepGrid::Candidate() const {
  double squares = 0;
  for (const Axis& axis : axes_) squares += axis.step * axis.step;
  return std::sqrt(squares);
}

}  // namespace cosserat_cable
