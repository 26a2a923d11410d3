#include "cosserat_cable/fit/damage.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/sample_runs.h"

namespace cosserat_cable {
namespace {

// So much of a channel may be unusable, and still its record counts.
constexpr double kMostUnusable = 0.02;
// Intervals of so many median ones, and of such a part of the record, are gaps.
constexpr double kGapPeriods = 5, kGapPart = 0.005;
constexpr double kPi = 3.14159265358979323846;
// First roots of cos cosh = -1 (clamped-free) and 1 (clamped-clamped).
constexpr double kClampedFree = 1.87510407, kClampedClamped = 4.73004074;

}  // namespace

Eigen::MatrixXd UsableSamples(const Record& record) {
  Eigen::MatrixXd usable = Eigen::MatrixXd::Ones(record.values.rows(), record.values.cols());
  if (record.quasi_static) return usable;
  for (Eigen::Index c = 0; c < usable.cols(); ++c) {
    const auto leave_out = [&](const SampleRun& run) {
      usable.col(c).segment(run.first, run.count).setZero();
    };
    for (const SampleRun& run : ClippedRuns(record.values.col(c))) leave_out(run);
    for (const SampleRun& run : FrozenRuns(record.values.col(c)))
      if (run.first + run.count < usable.rows()) leave_out(run);
  }
  return usable;
}

std::string DamageOf(const Record& record, const Eigen::MatrixXd& usable) {
  if (record.quasi_static || record.t.size() < 3) return "";
  for (Eigen::Index c = 0; c < usable.cols(); ++c) {
    const double unusable = 1 - usable.col(c).mean();
    if (unusable > kMostUnusable)
      return FormatRounded(100 * unusable, 2) + " % of a channel is clipped or frozen";
  }
  std::vector<double> intervals;
  for (std::size_t i = 1; i < record.t.size(); ++i)
    intervals.push_back(record.t[i] - record.t[i - 1]);
  const double longest = *std::max_element(intervals.begin(), intervals.end());
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  const double whole = record.t.back() - record.t.front();
  if (longest > kGapPeriods * *middle && longest > kGapPart * whole)
    return "it has a gap of " + FormatRounded(longest) + " s";
  return "";
}

double SlowestPeriod(const Experiment& experiment, const CableModel& cable) {
  return experiment.a.motion || experiment.b.motion ? 0 : RigPeriod(experiment, cable);
}

double RigPeriod(const Experiment& experiment, const CableModel& cable) {
  if (experiment.quasi_static()) return 0;
  const double L = cable.length;
  if (experiment.b.kind == EndCondition::Kind::kDisc) {
    const double J = experiment.b.disc.inertia + cable.rhoJ() * L / 3;
    return 2 * kPi * std::sqrt(J * L / cable.GJ);
  }
  const double mu = experiment.b.kind == EndCondition::Kind::kFree ? kClampedFree : kClampedClamped;
  return 2 * kPi * std::pow(L / mu, 2) *
         std::sqrt(cable.mass_per_length / std::min(cable.EI1, cable.EI2));
}

}  // namespace cosserat_cable
