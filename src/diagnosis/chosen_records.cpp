#include "chosen_records.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// Work in samples that are simulated for one linearisation: a set with more is large, and of a
// large one so much is done, with so many records at least.
constexpr double kLarge = 48e3, kEnough = 24e3;
constexpr int kFewest = 3;
// Simulations of a record for one linearisation; with an unknown start there are as many more.
constexpr double kCable = 5, kStart = 12;

double WorkOf(const Experiment& experiment) {
  if (experiment.quasi_static()) return 0;
  const bool unknown = experiment.start.kind == StartCondition::Kind::kUnknown;
  return static_cast<double>(experiment.record.t.size()) * (kCable + (unknown ? kStart : 0.0));
}

}  // namespace

std::vector<int> ChosenRecords(const MeasurementSet& set) {
  std::vector<int> moving, chosen;
  double work = 0;
  for (int e = 0; e < static_cast<int>(set.experiments.size()); ++e) {
    const Experiment& experiment = set.experiments[static_cast<std::size_t>(e)];
    (experiment.quasi_static() ? chosen : moving).push_back(e);
    work += WorkOf(experiment);
  }
  const auto all = static_cast<int>(moving.size());
  int count = all;
  if (work > kLarge)
    count = std::clamp(static_cast<int>(std::lround(all * kEnough / work)), std::min(kFewest, all),
                       all);
  for (int k = 0; k < count; ++k)
    chosen.push_back(moving[static_cast<std::size_t>(
        count > 1 ? std::lround(static_cast<double>(k) * (all - 1) / (count - 1)) : 0)]);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

MeasurementSet OfRecords(const MeasurementSet& set, const std::vector<int>& experiments) {
  MeasurementSet some = set;
  some.experiments.clear();
  for (const int e : experiments)
    some.experiments.push_back(set.experiments[static_cast<std::size_t>(e)]);
  return some;
}

}  // namespace cosserat_cable
