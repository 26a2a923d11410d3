#include "cosserat_cable/identification/record_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "cosserat_cable/rod/rod_batch.h"
#include "damage.h"

namespace cosserat_cable {
namespace {

// Coarse: what this costs in accuracy, Refine gives back.
constexpr int kElements = 20, kMostElements = 160;
// Of the samples' median interval, within bounds: a record shows nothing faster than its samples.
constexpr double kStepOfInterval = 0.25, kSmallestStep = 1e-3, kLargestStep = 5e-3;  // [s]
constexpr double kFinest = 1e-4;                                                     // [s]
// Rms of what the steps do, in parts of a channel's range, that asks for finer ones. What they do
// in a few samples only, at a shock, does not: those count less.
constexpr double kTooFar = 0.02;
// Of an unknown start: fewer do not tell it from the cable's parameters.
constexpr double kPeriods = 2;
constexpr std::size_t kFewestOfStart = 12;  // samples
constexpr int kSharpest = 8;                // times as fine as the fit's own runs
// In parts of an unknown's scale. Above what Newton's tolerance leaves, below what turns the phase
// at a record's end by a radian.
constexpr double kForwardStep = 1e-4;
constexpr double kCentralStep = 1e-3;

Eigen::VectorXd Moved(const Eigen::VectorXd& values, int unknown, double by) {
  Eigen::VectorXd moved = values;
  moved[unknown] += by;
  return moved;
}

double StepFor(const Record& record) {
  if (record.t.size() < 2) return kSmallestStep;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < record.t.size(); ++i)
    intervals.push_back(record.t[i] - record.t[i - 1]);
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return std::clamp(kStepOfInterval * *middle, kSmallestStep, kLargestStep);
}

/// Per sample, the part of all that the record moves that it has moved until then: squares of the
/// steps from sample to sample, each channel in parts of its own.
std::vector<double> MovedUntil(const Record& record) {
  std::vector<double> moved(record.t.size(), 0.0);
  for (Eigen::Index c = 0; c < record.values.cols(); ++c) {
    const Eigen::Index n = record.values.rows() - 1;
    const Eigen::VectorXd steps =
        (record.values.col(c).tail(n) - record.values.col(c).head(n)).array().square();
    const double all = steps.sum() * static_cast<double>(record.values.cols());
    for (Eigen::Index i = 0; i < n && all > 0; ++i)
      moved[static_cast<std::size_t>(i) + 1] += steps[i] / all;
  }
  std::partial_sum(moved.begin(), moved.end(), moved.begin());
  return moved;
}

/// As many elements as the experiment can start with: a long cable that a weight pulls straight
/// bends near its ends only, over a length that an element must not exceed by far.
int ElementsFor(const Experiment& experiment, const Specimen& specimen, SimulationOptions options) {
  options.until = -std::numeric_limits<double>::infinity();  // no further than the start
  const int few = options.elements;
  for (; options.elements <= kMostElements; options.elements *= 2)
    if (SimulateExperiment(experiment, {specimen}, options).front().ok) return options.elements;
  return few;
}

/// What steps do to a record, and how well that is known.
struct StepsEffect {
  Eigen::MatrixXd correction;  ///< what is to be added
  Eigen::MatrixXd error;       ///< what may be left then
};

/// What the steps of these options do to the records: from runs `sharpness` times as fine, 1.5 and
/// 2 times that, by the polynomial in the square of the fineness through the three, at zero. Two
/// runs would do for the error itself, but not for the square of the phase that it has built up at
/// a record's end, which looks like damping. What is left shrinks from three runs to more as it did
/// from two to three. Nothing where a run fails.
std::optional<StepsEffect> EffectOf(const Experiment& experiment, const Specimen& specimen,
                                    const SimulationOptions& options, int sharpness) {
  constexpr double kFineness[] = {1.0, 1.5, 2.0};
  const auto run = [&](double fineness) {
    SimulationOptions finer = options;
    finer.dt = options.dt / fineness;
    finer.elements = static_cast<int>(std::lround(options.elements * fineness));
    return SimulateExperiment(experiment, {specimen}, finer).front();
  };
  Eigen::MatrixXd values[3];
  for (int k = 0; k < 3; ++k) {
    SimulatedRecord record = run(sharpness * kFineness[k]);
    if (!record.ok) return std::nullopt;
    values[k] = std::move(record.values);
  }
  StepsEffect effect;
  if (sharpness == 1) {
    effect.correction = -values[0];
  } else {
    const SimulatedRecord own = run(1.0);
    if (!own.ok) return std::nullopt;
    effect.correction = -own.values;
  }
  Eigen::MatrixXd of_three = Eigen::MatrixXd::Zero(values[0].rows(), values[0].cols());
  for (int k = 0; k < 3; ++k) {
    // Lagrange's weight at zero, of x = 1/fineness^2.
    double weight = 1;
    for (int other = 0; other < 3; ++other)
      if (other != k) weight /= 1 - std::pow(kFineness[other] / kFineness[k], 2);
    of_three += weight * values[k];
  }
  effect.correction += of_three;
  const double ratio = std::pow(kFineness[2] / kFineness[1], 2);
  const Eigen::MatrixXd of_two = (ratio * values[2] - values[1]) / (ratio - 1);
  effect.error = of_three - of_two;
  for (Eigen::Index c = 0; c < effect.error.cols(); ++c) {
    const double gained = (of_two - values[2]).col(c).norm();
    if (gained > 0) effect.error.col(c) *= std::min(1.0, effect.error.col(c).norm() / gained);
  }
  return effect;
}

/// Root of the mean square of a correction, in parts of its channel's range; over the channels.
double RmsOf(const Experiment& experiment, const Eigen::MatrixXd& correction) {
  double largest = 0;
  for (Eigen::Index c = 0; c < correction.cols(); ++c) {
    const auto column = experiment.record.values.col(c);
    const double range =
        std::max(column.maxCoeff() - column.minCoeff(), column.cwiseAbs().maxCoeff());
    if (!(range > 0)) continue;
    const double n = static_cast<double>(correction.rows());
    largest = std::max(largest, correction.col(c).norm() / std::sqrt(n) / range);
  }
  return largest;
}

}  // namespace

RecordModel::RecordModel(const Unknowns& unknowns) : unknowns_(unknowns) {
  for (const Experiment& experiment : unknowns.set().experiments) {
    SimulationOptions options;
    options.elements = kElements;
    options.dt = StepFor(experiment.record);
    usable_.push_back(UsableSamples(experiment.record));
    double period = 0;
    Problems problems;
    const Specimen start =
        unknowns.MakeSpecimen(static_cast<int>(period_.size()), unknowns.StartValues(), &problems);
    if (problems.empty()) options.elements = ElementsFor(experiment, start, options);
    if (experiment.start.kind == StartCondition::Kind::kUnknown && problems.empty())
      period = SlowestPeriod(experiment, start.cable);
    period_.push_back(period);
    moved_.push_back(MovedUntil(experiment.record));
    options_.push_back(options);
    sharpness_.push_back(1);
    correction_.push_back(Eigen::MatrixXd::Zero(static_cast<int>(experiment.record.t.size()),
                                                static_cast<int>(experiment.channels.size())));
    error_.push_back(correction_.back());
  }
}

Horizon RecordModel::WholeHorizon() const { return PartialHorizon(1.0, 0); }

Horizon RecordModel::PartialHorizon(double part, int samples) const {
  Horizon horizon;
  for (const Experiment& experiment : unknowns_.set().experiments) {
    const std::vector<double>& t = experiment.record.t;
    const std::size_t e = horizon.size();
    const double least = t.front() + kPeriods * period_[e];
    const auto moved = static_cast<std::size_t>(
        std::lower_bound(moved_[e].begin(), moved_[e].end(), part) - moved_[e].begin() + 1);
    const auto count = std::clamp(
        std::max({static_cast<std::size_t>(std::ceil(part * static_cast<double>(t.size()))), moved,
                  static_cast<std::size_t>(samples)}),
        std::size_t{1}, t.size());
    horizon.push_back(
        experiment.quasi_static() ? t.back() : std::min(t.back(), std::max(least, t[count - 1])));
  }
  return horizon;
}

std::optional<Horizon> RecordModel::Beginning(double periods) const {
  const double longest = *std::max_element(period_.begin(), period_.end());
  if (!(longest > 0)) return std::nullopt;
  Horizon horizon;
  const auto& experiments = unknowns_.set().experiments;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const std::vector<double>& t = experiments[e].record.t;
    const double until = t.front() + periods * (period_[e] > 0 ? period_[e] : longest);
    const std::size_t fewest = std::min(kFewestOfStart, t.size()) - 1;
    horizon.push_back(
        experiments[e].quasi_static() ? t.back() : std::min(t.back(), std::max(until, t[fewest])));
  }
  return horizon;
}

bool RecordModel::Shows(int unknown, int experiment) const {
  return unknowns_.Concerns(unknown, experiment) && !ignored_.count({unknown, experiment});
}

bool RecordModel::LooksAlike(int experiment, const Eigen::VectorXd& p,
                             const Eigen::VectorXd& q) const {
  for (int i = 0; i < unknowns_.size(); ++i)
    if (p[i] != q[i] && unknowns_.all()[i].kind != Unknown::Kind::kOffset && Shows(i, experiment))
      return false;
  return true;
}

std::vector<RecordModel::Simulated> RecordModel::Simulate(
    const std::vector<Eigen::VectorXd>& points, const Horizon& horizon) const {
  const auto& experiments = unknowns_.set().experiments;
  // An experiment is simulated once for points that differ in nothing that it shows.
  std::vector<std::vector<std::size_t>> source(experiments.size());  // by experiment and point
  struct Task {
    int experiment;
    std::vector<std::size_t> points;
    std::vector<SimulatedRecord> results;
  };
  const auto together = static_cast<std::size_t>(rod::RodBatch::PreferredRods());
  std::vector<Task> tasks;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    std::vector<std::size_t> distinct;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const bool repeats = p > 0 && LooksAlike(static_cast<int>(e), points[p], points[0]);
      source[e].push_back(repeats ? 0 : p);
      if (!repeats) distinct.push_back(p);
    }
    for (std::size_t first = 0; first < distinct.size(); first += together) {
      const std::size_t last = std::min(first + together, distinct.size());
      tasks.push_back({static_cast<int>(e),
                       {distinct.begin() + static_cast<std::ptrdiff_t>(first),
                        distinct.begin() + static_cast<std::ptrdiff_t>(last)},
                       {}});
    }
  }
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t k) {
    Task& task = tasks[k];
    std::vector<Specimen> specimens;
    task.results.resize(task.points.size());
    std::vector<std::size_t> whose;
    for (std::size_t i = 0; i < task.points.size(); ++i) {
      Problems problems;
      Specimen specimen =
          unknowns_.MakeSpecimen(task.experiment, points[task.points[i]], &problems);
      if (!problems.empty()) {
        task.results[i].ok = false;
        task.results[i].message = problems.ToString();
        continue;
      }
      specimens.push_back(std::move(specimen));
      whose.push_back(i);
    }
    if (specimens.empty()) return;
    SimulationOptions options = options_[task.experiment];
    options.until = horizon[task.experiment];
    std::vector<SimulatedRecord> records =
        SimulateExperiment(experiments[task.experiment], specimens, options);
    for (std::size_t i = 0; i < records.size(); ++i) task.results[whose[i]] = std::move(records[i]);
  });

  std::vector<std::vector<SimulatedRecord>> raw(points.size(),
                                                std::vector<SimulatedRecord>(experiments.size()));
  for (Task& task : tasks)
    for (std::size_t i = 0; i < task.points.size(); ++i)
      raw[task.points[i]][task.experiment] = std::move(task.results[i]);
  for (std::size_t e = 0; e < experiments.size(); ++e)
    for (std::size_t p = 0; p < points.size(); ++p)
      if (source[e][p] != p) raw[p][e] = raw[source[e][p]][e];
  std::vector<Simulated> all;
  for (std::size_t p = 0; p < points.size(); ++p) all.push_back(Assemble(points[p], raw[p]));
  return all;
}

RecordModel::Simulated RecordModel::Assemble(const Eigen::VectorXd& values,
                                             const std::vector<SimulatedRecord>& raw) const {
  Simulated simulated;
  for (std::size_t e = 0; e < raw.size(); ++e) {
    if (!raw[e].ok) {
      simulated.ok = false;
      simulated.message = unknowns_.set().experiments[e].name + ": " + raw[e].message;
      return simulated;
    }
    Eigen::MatrixXd record = raw[e].values + correction_[e].topRows(raw[e].values.rows());
    for (int c = 0; c < record.cols(); ++c)
      record.col(c).array() += unknowns_.OffsetOf(static_cast<int>(e), c, values);
    if (!record.allFinite()) {
      simulated.ok = false;
      simulated.message = unknowns_.set().experiments[e].name + ": not finite";
      return simulated;
    }
    simulated.records.push_back(std::move(record));
  }
  return simulated;
}

RecordModel::Derivatives RecordModel::Differentiate(const Eigen::VectorXd& values,
                                                    const Horizon& horizon,
                                                    Difference difference) const {
  const int unknowns = unknowns_.size();
  const int experiments = static_cast<int>(unknowns_.set().experiments.size());
  const bool central = difference == Difference::kCentral;
  const double step = central ? kCentralStep : kForwardStep;
  std::vector<Eigen::VectorXd> points = {values};
  struct Column {
    std::size_t plus, minus;
    double span;  // in scales
  };
  std::vector<Column> columns;
  for (int i = 0; i < unknowns; ++i) {
    const Unknown& u = unknowns_.all()[i];
    // A damping stays above zero.
    const bool both = central && values[i] - step * u.scale >= u.lower;
    Column column{points.size(), 0, step};
    points.push_back(Moved(values, i, step * u.scale));
    if (both) {
      column.minus = points.size();
      column.span = 2 * step;
      points.push_back(Moved(values, i, -step * u.scale));
    }
    columns.push_back(column);
  }
  std::vector<Simulated> all = Simulate(points, horizon);
  Derivatives derivatives;
  for (const Simulated& one : all)
    if (!one.ok) {
      derivatives.at = one;
      return derivatives;
    }
  for (int i = 0; i < unknowns; ++i) {
    Records records(experiments);
    for (int e = 0; e < experiments; ++e)
      if (Shows(i, e))
        records[e] =
            (all[columns[i].plus].records[e] - all[columns[i].minus].records[e]) / columns[i].span;
    derivatives.by_unknown.push_back(std::move(records));
  }
  derivatives.at = std::move(all.front());
  return derivatives;
}

double RecordModel::Refine(const Eigen::VectorXd& values) {
  const auto& experiments = unknowns_.set().experiments;
  std::vector<double> largest(experiments.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, experiments.size(), [&](std::size_t e) {
    Problems problems;
    const Specimen specimen = unknowns_.MakeSpecimen(static_cast<int>(e), values, &problems);
    if (!problems.empty()) return;
    for (SimulationOptions options = options_[e];; options.dt /= 2, options.elements *= 2) {
      std::optional<StepsEffect> effect =
          EffectOf(experiments[e], specimen, options, sharpness_[e]);
      if (!effect) return;
      options_[e] = options;
      largest[e] = RelativeDifference(experiments[e], specimen.cable.length, effect->correction,
                                      experiments[e].record.values);
      const double rms = RmsOf(experiments[e], effect->correction);
      correction_[e] = std::move(effect->correction);
      error_[e] = std::move(effect->error);
      if (rms < kTooFar || options.dt < kFinest) return;
      if (sharpness_[e] > 1) sharpness_[e] /= 2;
    }
  });
  return *std::max_element(largest.begin(), largest.end());
}

bool RecordModel::Sharpen(int experiment) {
  int& sharpness = sharpness_[static_cast<std::size_t>(experiment)];
  if (sharpness >= kSharpest) return false;
  sharpness *= 2;
  return true;
}

}  // namespace cosserat_cable
