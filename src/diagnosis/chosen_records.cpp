#include "chosen_records.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// Work in samples that are simulated for one linearisation: a set with more is large, and of a
// large one so much is done, with so many records at least.
constexpr double kLarge = 64e3, kEnough = 24e3;
constexpr int kFewest = 3;
// Simulations of a record with an unknown start for one linearisation.
constexpr double kSimulations = 17;

bool IsDear(const Experiment& experiment) {
  return experiment.start.kind == StartCondition::Kind::kUnknown && !experiment.quasi_static();
}

}  // namespace

std::vector<int> ChosenRecords(const MeasurementSet& set) {
  std::vector<int> dear, chosen;
  double work = 0;
  for (int e = 0; e < static_cast<int>(set.experiments.size()); ++e) {
    const Experiment& experiment = set.experiments[static_cast<std::size_t>(e)];
    (IsDear(experiment) ? dear : chosen).push_back(e);
    if (IsDear(experiment)) work += kSimulations * static_cast<double>(experiment.record.t.size());
  }
  const auto all = static_cast<int>(dear.size());
  int count = all;
  if (work > kLarge)
    count = std::clamp(static_cast<int>(std::lround(all * kEnough / work)), std::min(kFewest, all),
                       all);
  for (int k = 0; k < count; ++k)
    chosen.push_back(dear[static_cast<std::size_t>(
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
