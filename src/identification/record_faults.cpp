#include "record_faults.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// Equal samples in a row that are looked at.
constexpr Eigen::Index kShortestRun = 5;
// How far beside them is looked: at so many samples, or at this share of the record. A signal that
// has decayed stands still for long, and moved long before that.
constexpr Eigen::Index kBeside = 16;
constexpr double kShareBeside = 0.02;
// Steps of the sensor's resolution by which the signal moves within as many samples beside them. A
// parabola's top that falls into one step moves by 8 there.
constexpr double kMovesBeside = 16;
// Share of a record that may be held samples: cameras repeat a frame now and then.
constexpr double kMayBeHeld = 0.01;

double Span(const Eigen::VectorXd& y, Eigen::Index from, Eigen::Index to) {
  from = std::max<Eigen::Index>(from, 0);
  to = std::min(to, y.size());
  if (to - from < 2) return 0;
  const auto part = y.segment(from, to - from);
  return part.maxCoeff() - part.minCoeff();
}

}  // namespace

std::string FaultOf(const Eigen::VectorXd& t, const Eigen::VectorXd& y) {
  if (!y.allFinite() || !t.allFinite()) return "has samples that are not finite";
  double resolution = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 1; i < t.size(); ++i) {
    if (t[i] <= t[i - 1]) return "has times that do not increase, at t = " + FormatRounded(t[i]);
    if (y[i] != y[i - 1]) resolution = std::min(resolution, std::abs(y[i] - y[i - 1]));
  }
  if (std::isinf(resolution)) return "is constant";
  const double high = y.maxCoeff(), low = y.minCoeff();
  // Differences of decimal numbers are off by their rounding: no resolution is finer.
  resolution = std::max(resolution, 1e-12 * (high - low));
  const double n = static_cast<double>(y.size());
  const Eigen::Index widest = std::max(kBeside, static_cast<Eigen::Index>(kShareBeside * n));
  Eigen::Index clipped = 0, frozen = 0, first_clipped = 0, first_frozen = 0;
  for (Eigen::Index i = 0; i < y.size();) {
    Eigen::Index end = i + 1;
    while (end < y.size() && y[end] == y[i]) ++end;
    const Eigen::Index length = end - i;
    const Eigen::Index beside = std::min(length, widest);
    if (length >= kShortestRun &&
        std::max(Span(y, i - beside, i + 1), Span(y, end - 1, end + beside)) >
            kMovesBeside * resolution) {
      const bool at_end = y[i] == high || y[i] == low;
      Eigen::Index& count = at_end ? clipped : frozen;
      if (count == 0) (at_end ? first_clipped : first_frozen) = i;
      count += length;
    }
    i = end;
  }
  const auto say = [&](const char* what, Eigen::Index count, Eigen::Index first) {
    return std::string("is ") + what + ": " + std::to_string(count) + " of " +
           std::to_string(y.size()) +
           " samples stand still while it moves beside them, the first at " +
           FormatRounded(y[first]) + " at t = " + FormatRounded(t[first]);
  };
  if (static_cast<double>(clipped) > kMayBeHeld * n) return say("clipped", clipped, first_clipped);
  if (static_cast<double>(frozen) > kMayBeHeld * n) return say("frozen", frozen, first_frozen);
  return "";
}

}  // namespace cosserat_cable
