#include "cosserat_cable/fit/record_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "cosserat_cable/fit/damage.h"
#include "cosserat_cable/rod/rod_batch.h"

namespace cosserat_cable {
namespace {

// Coarse: what this costs in accuracy, Refine gives back.
constexpr int kElements = 20;
constexpr int kElementsTried[] = {kElements, 24, 32, 40, 64, 80, 160};
// Of the samples' median interval, since a record shows nothing faster than its samples; and by how
// far a motion turns its phase in a step [rad]; within bounds.
constexpr double kStepOfInterval = 0.25, kStepOfMotion = 0.1;
constexpr double kSmallestStep = 1e-3, kLargestStep = 5e-3;  // [s]
// In a step so large the phase is wrong by a hundredth already: no bound keeps a step there. And
// one so small that nothing else that is slow asks for smaller ones.
constexpr double kMostOfMotion = 0.3, kLeastOfMotion = 0.02;
constexpr double kLargestOfSlow = 2e-2;  // [s]
constexpr double kFinest = 1e-4;         // [s]
// Rms of what the steps do, in parts of a channel's range, that asks for finer ones. What they do
// in a few samples only, at a shock, does not: those count less.
constexpr double kTooFar = 0.02;
// Of the noise, likewise, where that is more: it hides what a correction is wrong by.
constexpr double kBesideNoise = 0.5;
// Steps are not halved further where that leaves more than this part of what they do, since it
// converges to nothing, nor elements beyond these.
constexpr double kConverging = 0.7;
constexpr int kMostElements = 160;
constexpr double kWhole = 1e300;  // [s]
// Of an unknown start: fewer do not tell it from the cable's parameters.
constexpr double kPeriods = 2;
constexpr std::size_t kFewestOfStart = 12;  // samples
constexpr int kSharpest = 8;                // times as fine as the fit's own runs
// In parts of an unknown's scale. Above what Newton's tolerance leaves, below what turns the phase
// at a record's end by a radian.
constexpr double kSmallStep = 1e-4;

Eigen::VectorXd Moved(const Eigen::VectorXd& values, int unknown, double by) {
  Eigen::VectorXd moved = values;
  moved[unknown] += by;
  return moved;
}

bool IsOf(int unknown, const std::vector<bool>& which) {
  return !which.empty() && which[static_cast<std::size_t>(unknown)];
}

/// A step that resolves what the record shows: from how fast its channels move, and from its
/// samples.
double StepFor(const Record& record) {
  if (record.t.size() < 2) return kSmallestStep;
  double fastest = 0;  // [rad/s], root of the mean square of a rate beside that of the motion
  for (Eigen::Index c = 0; c < record.values.cols(); ++c) {
    const auto column = record.values.col(c);
    double rate = 0;
    for (std::size_t i = 1; i < record.t.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      rate += std::pow((column[k] - column[k - 1]) / (record.t[i] - record.t[i - 1]), 2);
    }
    const double motion = (column.array() - column.mean()).square().sum();
    if (motion > 0) fastest = std::max(fastest, std::sqrt(rate / motion));
  }
  const double of_motion = fastest > 0 ? kStepOfMotion / fastest : kLargestStep;
  const double smallest =
      fastest > 0 ? std::min(kSmallestStep, kMostOfMotion / fastest) : kSmallestStep;
  const double largest = fastest > 0
                             ? std::clamp(kLeastOfMotion / fastest, kLargestStep, kLargestOfSlow)
                             : kLargestStep;
  return std::clamp(std::max(kStepOfInterval * MedianInterval(record.t), of_motion), smallest,
                    largest);
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

/// Gives the options as many elements as the experiment can start with, and its rest: a long cable
/// that a weight pulls straight bends near its ends only, over a length that an element must not
/// exceed by far.
void FindElements(const Experiment& experiment, const Specimen& specimen,
                  SimulationOptions* options) {
  for (const int elements : kElementsTried)
    if ((options->rest = FindRest(experiment, specimen, elements, nullptr))) {
      options->elements = elements;
      return;
    }
}

/// Whether a correction is larger than is well corrected by it: in the root of its mean square,
/// beside the range of its channel and the channel's noise.
bool IsTooLarge(const Experiment& experiment, const Eigen::MatrixXd& correction,
                const Eigen::VectorXd& noise) {
  for (Eigen::Index c = 0; c < correction.cols(); ++c) {
    const auto column = experiment.record.values.col(c);
    const double range =
        std::max(column.maxCoeff() - column.minCoeff(), column.cwiseAbs().maxCoeff());
    const double rms = correction.col(c).norm() / std::sqrt(static_cast<double>(correction.rows()));
    if (rms > std::max(kTooFar * range, kBesideNoise * noise[c])) return true;
  }
  return false;
}

}  // namespace

RecordModel::SharedCount& RecordModel::OfAll() {
  static SharedCount count;
  return count;
}

SimulationCount RecordModel::CountOfAll() { return OfAll(); }

RecordModel::RecordModel(const Unknowns& unknowns)
    : unknowns_(unknowns), count_(std::make_unique<SharedCount>()) {
  for (const Experiment& experiment : unknowns.set().experiments) {
    SimulationOptions options;
    options.elements = kElements;
    options.dt = StepFor(experiment.record);
    usable_.push_back(UsableSamples(experiment.record));
    double period = 0;
    Problems problems;
    const Specimen start =
        unknowns.MakeSpecimen(static_cast<int>(period_.size()), unknowns.StartValues(), &problems);
    if (problems.empty()) FindElements(experiment, start, &options);
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

std::vector<std::vector<SimulatedRecord>> RecordModel::Run(const std::vector<Points>& points,
                                                           const Horizon& horizon) const {
  const auto& experiments = unknowns_.set().experiments;
  struct Task {
    int experiment;
    std::vector<std::size_t> points;
  };
  const auto together = static_cast<std::size_t>(rod::RodBatch::PreferredRods());
  std::vector<Task> tasks;
  std::vector<std::vector<SimulatedRecord>> results(experiments.size());
  // An experiment is simulated once for points that differ in nothing that it shows.
  std::vector<std::vector<std::size_t>> repeats(experiments.size());
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    results[e].resize(points[e].size());
    std::vector<std::size_t> distinct;
    for (std::size_t p = 0; p < points[e].size(); ++p)
      (p > 0 && LooksAlike(static_cast<int>(e), points[e][p], points[e][0]) ? repeats[e] : distinct)
          .push_back(p);
    for (std::size_t first = 0; first < distinct.size(); first += together) {
      const std::size_t last = std::min(first + together, distinct.size());
      tasks.push_back({static_cast<int>(e),
                       {distinct.begin() + static_cast<std::ptrdiff_t>(first),
                        distinct.begin() + static_cast<std::ptrdiff_t>(last)}});
    }
  }
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t k) {
    const Task& task = tasks[k];
    const auto e = static_cast<std::size_t>(task.experiment);
    std::vector<Specimen> specimens;
    std::vector<std::size_t> whose;
    for (const std::size_t p : task.points) {
      Problems problems;
      Specimen specimen = unknowns_.MakeSpecimen(task.experiment, points[e][p], &problems);
      if (!problems.empty()) {
        results[e][p].ok = false;
        results[e][p].message = problems.ToString();
        continue;
      }
      specimens.push_back(std::move(specimen));
      whose.push_back(p);
    }
    if (specimens.empty()) return;
    std::vector<SimulatedRecord> records =
        SimulateCounted(experiments[e], specimens, OptionsOf(e, horizon[e]));
    for (std::size_t i = 0; i < records.size(); ++i) results[e][whose[i]] = std::move(records[i]);
  });
  for (std::size_t e = 0; e < experiments.size(); ++e)
    for (const std::size_t p : repeats[e]) results[e][p] = results[e][0];
  return results;
}

SimulationOptions RecordModel::OptionsOf(std::size_t experiment, double until) const {
  SimulationOptions options = options_[experiment];
  options.until = until;
  options.stop = stop_;
  return options;
}

std::vector<SimulatedRecord> RecordModel::SimulateCounted(const Experiment& experiment,
                                                          const std::vector<Specimen>& specimens,
                                                          const SimulationOptions& options) const {
  const auto rods = static_cast<long>(specimens.size());
  SimulationCount count{rods, 0, 0};
  const double until = std::min(options.until, experiment.record.t.back());
  if (!experiment.quasi_static()) {
    count.steps = rods * std::lround(std::max(0.0, until - experiment.start_time()) / options.dt);
    count.element_steps = count.steps * options.elements;
  }
  count_->Add(count);
  OfAll().Add(count);
  return SimulateExperiment(experiment, specimens, options);
}

void RecordModel::Complete(int experiment, const Eigen::VectorXd& values,
                           SimulatedRecord* record) const {
  const auto e = static_cast<std::size_t>(experiment);
  const std::string& name = unknowns_.set().experiments[e].name;
  if (!record->ok) {
    record->message = name + ": " + record->message;
    return;
  }
  Eigen::MatrixXd& shown = record->values;
  shown += correction_[e].topRows(shown.rows());
  for (int c = 0; c < shown.cols(); ++c)
    shown.col(c).array() += unknowns_.OffsetOf(experiment, c, values);
  record->ok = shown.allFinite();
  if (!record->ok) record->message = name + ": not finite";
}

std::vector<RecordModel::Simulated> RecordModel::Gather(
    const std::vector<Eigen::VectorXd>& points, const std::vector<std::size_t>& first,
    std::vector<std::vector<SimulatedRecord>>* raw) const {
  std::vector<Simulated> all(points.size());
  for (std::size_t p = 0; p < points.size(); ++p)
    for (std::size_t e = 0; e < first.size() && all[p].ok; ++e) {
      SimulatedRecord& record = (*raw)[e][first[e] + p];
      Complete(static_cast<int>(e), points[p], &record);
      all[p].ok = record.ok;
      all[p].message = record.message;
      all[p].records.push_back(std::move(record.values));
    }
  return all;
}

std::vector<RecordModel::Simulated> RecordModel::Simulate(
    const std::vector<Eigen::VectorXd>& points, const Horizon& horizon) const {
  const std::size_t experiments = unknowns_.set().experiments.size();
  std::vector<std::vector<SimulatedRecord>> raw =
      Run(std::vector<Points>(experiments, points), horizon);
  return Gather(points, std::vector<std::size_t>(experiments, 0), &raw);
}

std::vector<RecordModel::Simulated> RecordModel::SimulateWith(
    const Eigen::VectorXd& values, const std::vector<Unknowns::Setting>& also) const {
  const auto& experiments = unknowns_.set().experiments;
  const auto together = static_cast<std::size_t>(rod::RodBatch::PreferredRods());
  const std::size_t groups = (also.size() + together - 1) / together;
  std::vector<std::vector<SimulatedRecord>> raw(experiments.size());
  for (auto& of : raw) of.resize(also.size());
  tbb::parallel_for(std::size_t{0}, experiments.size() * groups, [&](std::size_t task) {
    const std::size_t e = task / groups, first = task % groups * together;
    std::vector<Specimen> specimens;
    std::vector<std::size_t> whose;
    for (std::size_t k = first; k < std::min(first + together, also.size()); ++k) {
      Problems problems;
      specimens.push_back(unknowns_.MakeSpecimen(static_cast<int>(e), values, also[k], &problems));
      whose.push_back(k);
      if (problems.empty()) continue;
      raw[e][k].ok = false;
      raw[e][k].message = problems.ToString();
      specimens.pop_back();
      whose.pop_back();
    }
    if (specimens.empty()) return;
    std::vector<SimulatedRecord> records =
        SimulateCounted(experiments[e], specimens, OptionsOf(e, kWhole));
    for (std::size_t i = 0; i < records.size(); ++i) raw[e][whose[i]] = std::move(records[i]);
  });
  return Gather(std::vector<Eigen::VectorXd>(also.size(), values),
                std::vector<std::size_t>(experiments.size(), 0), &raw);
}

void RecordModel::TakeStepsFrom(const RecordModel& other) {
  options_ = other.options_;
  sharpness_ = other.sharpness_;
  for (std::size_t e = 0; e < correction_.size(); ++e) {
    const Eigen::Index rows = correction_[e].rows();
    correction_[e] = other.correction_[e].topRows(rows);
    error_[e] = other.error_[e].topRows(rows);
  }
}

void RecordModel::TakeStepsFrom(const RecordModel& other, int experiment) {
  const auto e = static_cast<std::size_t>(experiment);
  options_ = {other.options_[e]};
  sharpness_ = {other.sharpness_[e]};
  correction_ = {other.correction_[e]};
  error_ = {other.error_[e]};
}

int RecordModel::MostShown(const std::vector<bool>& left_out) const {
  int most = 0;
  for (int e = 0; e < static_cast<int>(unknowns_.set().experiments.size()); ++e) {
    int shown = 0;
    for (int i = 0; i < unknowns_.size(); ++i) shown += Shows(i, e) && !IsOf(i, left_out);
    most = std::max(most, shown);
  }
  return most;
}

Eigen::VectorXd RecordModel::SmallSteps() const {
  return Eigen::VectorXd::Constant(unknowns_.size(), kSmallStep);
}

RecordModel::Derivatives RecordModel::Differentiate(const Eigen::VectorXd& values,
                                                    const Horizon& horizon, Difference difference,
                                                    const Eigen::VectorXd& steps,
                                                    const std::vector<Eigen::VectorXd>& others,
                                                    const std::vector<bool>& left_out) const {
  const std::size_t experiments = unknowns_.set().experiments.size();
  struct Column {
    int unknown;
    std::size_t plus = 0, minus = 0;  // points; 0: the values themselves
  };
  std::vector<std::vector<Column>> columns(experiments);
  std::vector<Points> points(experiments, Points{values});
  const auto step_of = [&](int i) { return steps[i] * unknowns_.all()[i].scale; };
  const auto inside = [&](int i, double by) {
    const Unknown& u = unknowns_.all()[i];
    return values[i] + by >= u.lower && values[i] + by <= u.upper;
  };
  for (std::size_t e = 0; e < experiments; ++e)
    for (int i = 0; i < unknowns_.size(); ++i) {
      if (!Shows(i, static_cast<int>(e)) || IsOf(i, left_out)) continue;
      Column column{i};
      const double by = step_of(i);
      const bool up = inside(i, by) || !inside(i, -by);  // a damping stays above zero
      const bool down = !up || (difference == Difference::kCentral && inside(i, -by));
      for (const bool plus : {true, false}) {
        if (!(plus ? up : down)) continue;
        (plus ? column.plus : column.minus) = points[e].size();
        points[e].push_back(Moved(values, i, plus ? by : -by));
      }
      columns[e].push_back(column);
    }
  std::vector<std::size_t> first_other;
  for (Points& of : points) {
    first_other.push_back(of.size());
    of.insert(of.end(), others.begin(), others.end());
  }
  std::vector<std::vector<SimulatedRecord>> all = Run(points, horizon);
  Derivatives derivatives;
  derivatives.others = Gather(others, first_other, &all);
  for (std::size_t e = 0; e < experiments; ++e) {
    all[e].resize(first_other[e]);
    points[e].resize(first_other[e]);
  }

  // Where one side fails, the other one does.
  std::vector<Points> opposite(experiments, Points{values});
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> replaced(experiments);
  for (std::size_t e = 0; e < experiments; ++e) {
    for (Column& column : columns[e])
      for (std::size_t* side : {&column.plus, &column.minus}) {
        if (*side == 0 || all[e][*side].ok) continue;
        const bool was_plus = side == &column.plus;
        *side = 0;
        if (column.plus != 0 || column.minus != 0) continue;
        std::size_t& other = was_plus ? column.minus : column.plus;
        const double by = was_plus ? -step_of(column.unknown) : step_of(column.unknown);
        other = points[e].size() + replaced[e].size();
        replaced[e].push_back({other, opposite[e].size()});
        opposite[e].push_back(Moved(values, column.unknown, by));
        break;
      }
    if (replaced[e].empty()) opposite[e].clear();
  }
  if (std::any_of(opposite.begin(), opposite.end(), [](const Points& p) { return !p.empty(); })) {
    std::vector<std::vector<SimulatedRecord>> more = Run(opposite, horizon);
    for (std::size_t e = 0; e < experiments; ++e)
      for (const auto& [place, from] : replaced[e]) {
        all[e].resize(std::max(all[e].size(), place + 1));
        all[e][place] = std::move(more[e][from]);
        points[e].resize(std::max(points[e].size(), place + 1));
        points[e][place] = opposite[e][from];
      }
  }

  derivatives.slopes.resize(experiments);
  for (std::size_t e = 0; e < experiments; ++e) {
    for (std::size_t p = 0; p < all[e].size(); ++p)
      Complete(static_cast<int>(e), points[e][p], &all[e][p]);
    for (const Column& column : columns[e]) {
      const SimulatedRecord &plus = all[e][column.plus], &minus = all[e][column.minus];
      if (!plus.ok || !minus.ok) {
        derivatives.at.ok = false;
        derivatives.at.message = plus.ok ? minus.message : plus.message;
        return derivatives;
      }
      const double span =
          points[e][column.plus][column.unknown] - points[e][column.minus][column.unknown];
      derivatives.slopes[e].push_back(
          {column.unknown,
           (plus.values - minus.values) / (span / unknowns_.all()[column.unknown].scale)});
    }
    if (!all[e][0].ok) {
      derivatives.at.ok = false;
      derivatives.at.message = all[e][0].message;
      return derivatives;
    }
    derivatives.at.records.push_back(std::move(all[e][0].values));
  }
  return derivatives;
}

/// What the steps of these options do to the records: from runs `sharpness` times as fine, 1.5 and
/// 2 times that, by the polynomial in the square of the fineness through the three, at zero. Two
/// runs would do for the error itself, but not for the square of the phase that it has built up at
/// a record's end, which looks like damping. What is left shrinks from three runs to more as it did
/// from two to three. Nothing where a run fails.
std::optional<RecordModel::StepsEffect> RecordModel::EffectOf(const Experiment& experiment,
                                                              const Specimen& specimen,
                                                              const SimulationOptions& options,
                                                              int sharpness) const {
  constexpr double kFineness[] = {1.0, 1.5, 2.0};
  std::vector<double> fineness;
  for (const double part : kFineness) fineness.push_back(sharpness * part);
  if (sharpness > 1) fineness.push_back(1.0);
  std::vector<SimulatedRecord> runs(fineness.size());
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t k) {
    SimulationOptions finer = options;
    finer.dt = options.dt / fineness[k];
    finer.elements = static_cast<int>(std::lround(options.elements * fineness[k]));
    runs[k] = SimulateCounted(experiment, {specimen}, finer).front();
  });
  for (const SimulatedRecord& one : runs)
    if (!one.ok) return std::nullopt;
  StepsEffect effect;
  const Eigen::MatrixXd& own = sharpness > 1 ? runs.back().values : runs.front().values;
  Eigen::MatrixXd of_three = Eigen::MatrixXd::Zero(own.rows(), own.cols());
  for (int k = 0; k < 3; ++k) {
    // Lagrange's weight at zero, of x = 1/fineness^2.
    double weight = 1;
    for (int other = 0; other < 3; ++other)
      if (other != k) weight /= 1 - std::pow(kFineness[other] / kFineness[k], 2);
    of_three += weight * runs[k].values;
  }
  effect.correction = of_three - own;
  const double ratio = std::pow(kFineness[2] / kFineness[1], 2);
  const Eigen::MatrixXd of_two = (ratio * runs[2].values - runs[1].values) / (ratio - 1);
  effect.error = of_three - of_two;
  for (Eigen::Index c = 0; c < effect.error.cols(); ++c) {
    const double gained = (of_two - runs[2].values).col(c).norm();
    if (gained > 0) effect.error.col(c) *= std::min(1.0, effect.error.col(c).norm() / gained);
  }
  return effect;
}

double RecordModel::Refine(const Eigen::VectorXd& values, const NoiseLevels& noise) {
  const auto& experiments = unknowns_.set().experiments;
  std::vector<double> largest(experiments.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, experiments.size(), [&](std::size_t e) {
    Problems problems;
    const Specimen specimen = unknowns_.MakeSpecimen(static_cast<int>(e), values, &problems);
    if (!problems.empty()) return;
    for (SimulationOptions options = OptionsOf(e, kWhole);;
         options.dt /= 2, options.elements *= 2) {
      std::optional<StepsEffect> effect =
          EffectOf(experiments[e], specimen, options, sharpness_[e]);
      if (!effect) return;
      options_[e].dt = options.dt;
      options_[e].elements = options.elements;
      const double before = largest[e];
      largest[e] = RelativeDifference(experiments[e], specimen.cable.length, effect->correction,
                                      experiments[e].record.values);
      const bool in_vain = before > 0 && largest[e] > kConverging * before;
      const bool done = in_vain || options.dt < kFinest || options.elements > kMostElements / 2 ||
                        !IsTooLarge(experiments[e], effect->correction, noise[e]);
      correction_[e] = std::move(effect->correction);
      error_[e] = std::move(effect->error);
      if (done) break;
      if (sharpness_[e] > 1) sharpness_[e] /= 2;
    }
    const auto rest =
        FindRest(experiments[e], specimen, options_[e].elements, options_[e].rest.get());
    if (rest) options_[e].rest = rest;
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
