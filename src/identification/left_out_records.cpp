// Records that count for nothing: damaged ones, those shorter than a period, and those that show
// nothing but noise.
#include <algorithm>
#include <cmath>

#include "cosserat_cable/fit/damage.h"
#include "cosserat_cable/fit/noise_level.h"
#include "cosserat_cable/input/number_text.h"
#include "estimation_work.h"

namespace cosserat_cable {
namespace {

// What the largest of a record's frequencies gains by chance, in its sum of squares by the noise's,
// grows as twice the logarithm of their number; twice that, and a base for short records.
constexpr double kSilentBase = 20, kSilentPerLog = 4;

}  // namespace

/// Whether all records that the unknown concerns count for nothing.
bool EstimationWork::ShownByNone(int unknown) const {
  for (std::size_t e = 0; e < experiments().size(); ++e)
    if (unknowns_.Concerns(unknown, static_cast<int>(e)) && !model_.IsLeftOut(static_cast<int>(e)))
      return false;
  return true;
}

void EstimationWork::LeaveOut(std::size_t experiment, const std::string& why) {
  model_.LeaveOut(static_cast<int>(experiment));
  estimation_.warnings.push_back(experiments()[experiment].name + ": " + why);
}

void EstimationWork::LeaveOutDamaged() {
  if (options_.use_damaged) return;
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    const std::string why = DamageOf(experiments()[e].record, model_.usable()[e]);
    if (!why.empty())
      LeaveOut(e, why + ": the record counts for nothing (--use-damaged takes what is left of it)");
  }
}

void EstimationWork::LeaveOutShort() {
  if (options_.use_damaged) return;
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    Problems problems;
    const Specimen specimen =
        unknowns_.MakeSpecimen(static_cast<int>(e), optimum_.values, &problems);
    const std::vector<double>& t = experiments()[e].record.t;
    const double period = SlowestPeriod(experiments()[e], specimen.cable);
    if (model_.IsLeftOut(static_cast<int>(e)) || t.back() - t.front() >= period) continue;
    LeaveOut(e, "the record of " + FormatRounded(t.back() - t.front()) +
                    " s is shorter than a period, some " + FormatRounded(period, 2) +
                    " s, and counts for nothing (--use-damaged takes it)");
  }
}

/// The noise of a channel, independent of the fit.
NoiseLevel EstimationWork::Level(std::size_t e, int column) const {
  const Experiment& experiment = experiments()[e];
  // The record's own samples, also where it counts for nothing.
  const Eigen::VectorXd usable = UsableSamples(experiment.record).col(column);
  NoiseLevel level = LevelOf(experiment, column, usable, simulated_[e].col(column));
  if (level.source == NoiseLevel::Source::kGiven || level.source == NoiseLevel::Source::kUnknown)
    return level;
  level.sd = std::max(level.sd, SmallestNoise(experiment, column));
  return level;
}

bool EstimationWork::MovesBeyondNoise(std::size_t e) const {
  const Experiment& experiment = experiments()[e];
  for (int c = 0; c < static_cast<int>(experiment.channels.size()); ++c) {
    const Eigen::VectorXd values = experiment.record.values.col(c);
    const Eigen::VectorXd about = values.array() - values.mean();
    const NoiseLevel level = LevelOf(experiment, c, model_.usable()[e].col(c));
    if (IsMisfit(RootMeanSquare(about), static_cast<double>(about.size()), level)) return true;
  }
  return false;
}

/// Records that the simulation explains no better than a constant does show nothing but noise, and
/// whatever the search found in them was luck; or they move, and nothing explains how. Where the
/// cable stands still, the constants are what was measured: all but unknown offsets.
/// @return whether one was left out that moves, and others remain: the fit is to be repeated
bool EstimationWork::LeaveOutSilent() {
  bool pulled = false;
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    const Experiment& experiment = experiments()[e];
    if (model_.IsLeftOut(static_cast<int>(e))) continue;
    const bool stands =
        experiment.quasi_static() ||
        (experiment.start.kind == StartCondition::Kind::kRest && !experiment.a.motion &&
         !experiment.b.motion && experiment.load.file.empty());
    if (stands && std::any_of(experiment.channels.begin(), experiment.channels.end(),
                              [](const Channel& channel) { return !channel.unknown_offset; }))
      continue;
    double gain = 0;
    Eigen::Index samples = 0;
    for (int c = 0; c < static_cast<int>(experiment.channels.size()); ++c) {
      const Eigen::MatrixXd constant = Eigen::MatrixXd::Constant(
          simulated_[e].rows(), simulated_[e].cols(), experiment.record.values.col(c).mean());
      const Eigen::MatrixXd counted = Counted(e);
      const double variance = noise_[e][c] * noise_[e][c];
      gain += (CountedResiduals(experiment, constant, counted, c).squaredNorm() -
               CountedResiduals(experiment, simulated_[e], counted, c).squaredNorm()) /
              variance;
      samples += simulated_[e].rows();
    }
    if (gain > kSilentBase + kSilentPerLog * std::log(static_cast<double>(samples))) continue;
    if (MovesBeyondNoise(e)) {
      LeaveOut(e,
               "the record moves by far more than its noise, and the simulation explains none "
               "of it with any parameters: it counts for nothing");
      pulled = true;
    } else {
      LeaveOut(e, "the record shows nothing but noise, and counts for nothing");
    }
  }
  for (std::size_t e = 0; e < experiments().size() && pulled; ++e)
    if (!model_.IsLeftOut(static_cast<int>(e))) return true;
  return false;
}

}  // namespace cosserat_cable
