#include "cosserat_cable/identification/estimation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>

#include "channel_slips.h"
#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/input/number_text.h"
#include "damage.h"
#include "estimation_remarks.h"
#include "fit.h"
#include "information.h"
#include "noise.h"
#include "noise_level.h"
#include "profile.h"
#include "record_scatter.h"
#include "weighted_line.h"

namespace cosserat_cable {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kNormal95 = 1.959964;
constexpr int kMaxRounds = 6;
// A further round of steps, noise and fit is worth it where values moved by more than this part of
// their standard deviation, or a noise by this part.
constexpr double kSettled = 0.1, kNoiseSettled = 0.05;
// What the largest of a record's frequencies gains by chance, in its sum of squares by the noise's,
// grows as twice the logarithm of their number; twice that, and a base for short records.
constexpr double kSilentBase = 20, kSilentPerLog = 4;
// What the simulation's remaining error may move any parameter by, in its standard deviations, and
// the part of the noise below which a sample has none.
constexpr double kMostShift = 0.2, kResolved = 0.5;
// Squared norm of a derivative, by an unknown's scale, that shows nothing of it; and what keeps
// directions that the records do not show from passing for some that they do.
constexpr double kUnshown = 1e-3, kRidge = 1e-10;
// Times the noise.
constexpr double kFarMore = 30;
// Half of a sum of squares: a fit that is worse by no more is as good.
constexpr double kAsWell = 2;
// Of the whole work: what is done when the records are fitted as a whole, and what a round adds.
constexpr double kPartOfStart = 0.35, kPartOfRound = 0.08;
// How often what differs between records is estimated anew, and the change that ends it.
constexpr int kScatterRounds = 6;
constexpr double kScatterSettled = 0.05;

/// Residuals of a channel at the samples that `count`.
Eigen::VectorXd CountedResiduals(const Experiment& experiment, const Eigen::MatrixXd& simulated,
                                 const Eigen::MatrixXd& count, int column) {
  std::vector<double> residuals;
  for (Eigen::Index i = 0; i < simulated.rows(); ++i)
    if (count(i, column) > 0)
      residuals.push_back(experiment.record.values(i, column) - simulated(i, column));
  return Eigen::Map<Eigen::VectorXd>(residuals.data(), static_cast<Eigen::Index>(residuals.size()));
}

double Rms(const Eigen::VectorXd& values) {
  return values.size() > 0 ? std::sqrt(values.squaredNorm() / static_cast<double>(values.size()))
                           : 0.0;
}

/// The work, step by step.
class Work {
 public:
  Work(const Unknowns& unknowns, const EstimationOptions& options)
      : unknowns_(unknowns), options_(options), model_(unknowns) {
    model_.SetStop([this] { return Stopped() || OutOfTime(); });
  }
  Work(const Work&) = delete;

  /// False: there is none, and Answer says why.
  bool FitFromStart();
  /// Whether the work ended before its time.
  bool hurried() const { return hurried_; }
  /// Whether what is left is far more than noise.
  bool misfit() const { return misfit_; }
  /// From where another fit ended, which knew less of what differs between records.
  bool FitFrom(const Work& before);
  std::vector<ParameterScatter> Scatter() const {
    return FindScatter(model_, {optimum_.values, optimum_.residuals, optimum_.jacobian, colours_});
  }
  /// @pre the fit succeeded
  void Report(const std::vector<ParameterScatter>& scatter);
  Estimation Answer() const { return estimation_; }

 private:
  const std::vector<Experiment>& experiments() const { return unknowns_.set().experiments; }
  /// What was simulated since the last call belongs to this stage.
  void Charge(const std::string& stage);
  bool Tell(const std::string& what, double part) {
    if (options_.progress && !options_.progress(what, part)) stopped_ = true;
    return !model_.Stopping();
  }
  NoiseLevel Level(std::size_t experiment, int column) const;
  bool MovesBeyondNoise(std::size_t experiment) const;
  Eigen::MatrixXd Counted(std::size_t experiment) const;
  bool Sharpen(const RecordJacobian& jacobian);
  bool ShownByNone(int unknown) const;
  bool UpdateNoise();
  bool FitInRounds();
  bool FitToEnd();
  bool Stopped() const { return stopped_ || (options_.stop && options_.stop()); }
  bool OutOfTime() const {
    return options_.time_limit > 0 &&
           std::chrono::duration<double>(Clock::now() - begin_).count() > options_.time_limit;
  }
  bool Hurry();
  void LoosenNoise();
  void LeaveOut(std::size_t experiment, const std::string& why);
  void LeaveOutDamaged();
  void LeaveOutShort();
  bool LeaveOutSilent();
  bool Conclude();
  void FindColours();
  double QuantileOf(int unknown, const Determination& determination,
                    const Information& information) const;
  void ReportChannels();
  void KeepDefaults(const Determination& determination);

  const Unknowns& unknowns_;
  const EstimationOptions& options_;
  RecordModel model_;
  NoiseLevels noise_;
  Optimum optimum_;
  Eigen::VectorXd steps_;  // of the differences, in the unknowns' scales
  FitResult fit_;          // the last one of whole records
  std::atomic<bool> stopped_{false};
  bool hurried_ = false;
  bool misfit_ = false;  // what is left is far more than noise: it takes no precision to see
  std::string end_;      // why the fit is no minimum; empty where it is
  Records simulated_;
  std::vector<std::vector<NoiseColour>> colours_;
  Estimation estimation_;
  Clock::time_point begin_ = Clock::now(), charged_at_ = begin_;
  SimulationCount charged_;
};

void Work::Charge(const std::string& stage) {
  const Clock::time_point now = Clock::now();
  auto& stages = estimation_.stages;
  auto place = std::find_if(stages.begin(), stages.end(),
                            [&](const StageCost& one) { return one.name == stage; });
  if (place == stages.end()) place = stages.insert(place, {stage, 0, {}});
  place->seconds += std::chrono::duration<double>(now - charged_at_).count();
  place->count += model_.count() - charged_;
  charged_ = model_.count();
  charged_at_ = now;
}

/// One for samples that a sensor measured and the simulation resolves; all that were measured where
/// it hardly resolves any.
Eigen::MatrixXd Work::Counted(std::size_t e) const {
  Eigen::MatrixXd counted = model_.usable()[e];
  for (Eigen::Index c = 0; c < counted.cols(); ++c) {
    const auto resolved =
        (model_.error()[e].col(c).array().abs() < kResolved * noise_[e][c]).cast<double>();
    if (2 * resolved.sum() > static_cast<double>(counted.rows()))
      counted.col(c).array() *= resolved;
  }
  return counted;
}

/// Finer runs behind the corrections of experiments whose remaining errors move the parameters: by
/// no more, in standard deviations of any of them, than the part of the error that lies in the
/// derivatives' space is long.
bool Work::Sharpen(const RecordJacobian& jacobian) {
  // The part of an error e in the derivatives' space: |R^-T J^T e|, with R^T R = J^T J.
  const Eigen::MatrixXd gram = jacobian.Gram();
  const Eigen::VectorXd unit =
      gram.diagonal().unaryExpr([](double x) { return x > kUnshown ? 1 / std::sqrt(x) : 0.0; });
  Eigen::MatrixXd normal = unit.asDiagonal() * gram * unit.asDiagonal();
  normal.diagonal().array() += kRidge;
  const Eigen::LLT<Eigen::MatrixXd> factor(normal);
  bool sharper = false;
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    const Eigen::MatrixXd error = model_.error()[e].cwiseProduct(SampleWeights(model_, e, noise_));
    const Eigen::Map<const Eigen::VectorXd> column(error.data(), error.size());
    const RecordJacobian::Record& record = jacobian.records()[e];
    const Eigen::VectorXd part = record.columns.transpose() * column;
    Eigen::VectorXd all = Eigen::VectorXd::Zero(gram.rows());
    for (std::size_t k = 0; k < record.unknowns.size(); ++k)
      all[record.unknowns[k]] = unit[record.unknowns[k]] * part[static_cast<Eigen::Index>(k)];
    const double shift = factor.matrixL().solve(all).norm();
    if (shift > kMostShift) sharper |= model_.Sharpen(static_cast<int>(e));
  }
  return sharper;
}

/// Where the noise is not given, the residuals say what it is. False: it had been right.
bool Work::UpdateNoise() {
  bool changed = false;
  for (std::size_t e = 0; e < experiments().size(); ++e)
    for (std::size_t c = 0; c < experiments()[e].channels.size(); ++c) {
      if (experiments()[e].channels[c].sigma) continue;
      const int column = static_cast<int>(c);
      const double rms =
          std::max(Rms(CountedResiduals(experiments()[e], simulated_[e], Counted(e), column)),
                   SmallestNoise(experiments()[e], column));
      changed |= std::abs(rms / noise_[e][column] - 1) > kNoiseSettled;
      noise_[e][column] = rms;
    }
  return changed;
}

/// False: stopped, or there is no fit and `message` says why.
bool Work::FitInRounds() {
  bool noise_changed = true;
  double last_move = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (!Tell("comparing with finer steps", kPartOfStart + kPartOfRound * round)) return false;
    estimation_.discretisation = model_.Refine(optimum_.values, noise_);
    Charge("steps in space and time");
    const Eigen::VectorXd before = optimum_.values;
    const FitProgress progress = [&](const std::string& what) {
      return Tell("fitting whole records, " + what, kPartOfStart + kPartOfRound * (round + 0.5));
    };
    if (noise_changed || !Polish(model_, fit_.jacobian, noise_, &optimum_.values)) {
      FitOptions options;
      options.steps = fit_.steps;
      options.to_noise = !misfit_;
      const FitResult fit =
          Fit(model_, optimum_.values, model_.WholeHorizon(), noise_, options, progress);
      if (!fit.ok && round == 0) {
        estimation_.message = "the fit does not converge: " + fit.message;
        return false;
      }
      if (!fit.ok) {
        // With finer steps the cable cannot be simulated there: what was found before stands.
        end_ = "finer steps do not simulate the cable as it was found: " + fit.message;
        return !model_.Stopping();
      }
      fit_ = fit;
      optimum_.values = fit_.values;
      if (fit_.interrupted) return false;
    }
    steps_ = fit_.steps;
    Charge("fit");
    const RecordModel::Simulated found =
        model_.Simulate({optimum_.values}, model_.WholeHorizon()).front();
    if (!found.ok) return false;
    simulated_ = found.records;
    noise_changed = UpdateNoise();
    // In standard deviations, over all unknowns together.
    Eigen::VectorXd moved_by = optimum_.values - before;
    for (int i = 0; i < unknowns_.size(); ++i) moved_by[i] /= unknowns_.all()[i].scale;
    const double moved = std::sqrt(moved_by.dot(fit_.jacobian.Gram() * moved_by));
    const bool sharper = !misfit_ && Sharpen(fit_.jacobian);
    // Corrections follow the values, and the values the corrections: by the same part each time.
    const double next = last_move > moved ? moved * moved / last_move : moved;
    last_move = moved;
    if (round > 0 && (misfit_ || (!noise_changed && !sharper && next < kSettled))) break;
  }
  end_ = fit_.at_minimum
             ? ""
             : "no step gains anything, although some should: the records' misfit is rough";
  return true;
}

bool Work::FitToEnd() {
  if (!FitInRounds()) return Hurry();
  LeaveOutShort();
  // What was left out has pulled at the rest until now.
  if (LeaveOutSilent() && !FitInRounds()) return Hurry();
  return Conclude() || Hurry();
}

/// Ends with what was found so far, as fast as it can. False: nothing was found, or there was no
/// hurry, and `message` says why.
bool Work::Hurry() {
  if (!model_.Stopping()) return false;
  estimation_.interrupted = Stopped();
  model_.SetStop(nullptr);
  hurried_ = true;
  estimation_.message.clear();
  end_ = estimation_.interrupted
             ? "interrupted"
             : "the time limit of " + FormatRounded(options_.time_limit) + " s was reached";
  RecordModel::Simulated found = model_.Simulate({optimum_.values}, model_.WholeHorizon()).front();
  if (!found.ok) {
    estimation_.message = found.message;
    return false;
  }
  simulated_ = std::move(found.records);
  UpdateNoise();
  optimum_.residuals = WeightedResiduals(model_, optimum_.values, simulated_, noise_);
  optimum_.jacobian = fit_.jacobian;
  Eigen::Index rows = 0;
  for (const RecordJacobian::Record& record : fit_.jacobian.records())
    rows += record.columns.rows();
  if (rows < FirstRow(model_, static_cast<int>(experiments().size()))) {
    Eigen::VectorXd steps = model_.SmallSteps();
    Linearised last = Linearise(model_, optimum_.values, model_.WholeHorizon(), noise_,
                                RecordModel::Difference::kForward, false, &steps);
    if (!last.ok) {
      estimation_.message = last.message;
      return false;
    }
    optimum_.jacobian = std::move(last.jacobian);
  }
  FindColours();
  Charge("derivatives at the end");
  return true;
}

void Work::FindColours() {
  colours_.clear();
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    colours_.emplace_back();
    for (int c = 0; c < static_cast<int>(experiments()[e].channels.size()); ++c)
      colours_.back().push_back(ColourOf(
          CountedResiduals(experiments()[e], simulated_[e], Counted(e), c) / noise_[e][c]));
  }
}

/// Whether all records that the unknown concerns count for nothing.
bool Work::ShownByNone(int unknown) const {
  for (std::size_t e = 0; e < experiments().size(); ++e)
    if (unknowns_.Concerns(unknown, static_cast<int>(e)) && !model_.IsLeftOut(static_cast<int>(e)))
      return false;
  return true;
}

void Work::LeaveOut(std::size_t experiment, const std::string& why) {
  model_.LeaveOut(static_cast<int>(experiment));
  estimation_.warnings.push_back(experiments()[experiment].name + ": " + why);
}

void Work::LeaveOutDamaged() {
  if (options_.use_damaged) return;
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    const std::string why = DamageOf(experiments()[e].record, model_.usable()[e]);
    if (!why.empty())
      LeaveOut(e, why + ": the record counts for nothing (--use-damaged takes what is left of it)");
  }
}

void Work::LeaveOutShort() {
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
NoiseLevel Work::Level(std::size_t e, int column) const {
  const Experiment& experiment = experiments()[e];
  // The record's own samples, also where it counts for nothing.
  const Eigen::VectorXd usable = UsableSamples(experiment.record).col(column);
  NoiseLevel level = LevelOf(experiment, column, usable, simulated_[e].col(column));
  if (level.source == NoiseLevel::Source::kGiven || level.source == NoiseLevel::Source::kUnknown)
    return level;
  level.sd = std::max(level.sd, SmallestNoise(experiment, column));
  return level;
}

bool Work::MovesBeyondNoise(std::size_t e) const {
  const Experiment& experiment = experiments()[e];
  for (int c = 0; c < static_cast<int>(experiment.channels.size()); ++c) {
    const Eigen::VectorXd values = experiment.record.values.col(c);
    const Eigen::VectorXd about = values.array() - values.mean();
    const NoiseLevel level = LevelOf(experiment, c, model_.usable()[e].col(c));
    if (IsMisfit(Rms(about), static_cast<double>(about.size()), level)) return true;
  }
  return false;
}

/// Records that the simulation explains no better than a constant does show nothing but noise, and
/// whatever the search found in them was luck; or they move, and nothing explains how. Where the
/// cable stands still, the constants are what was measured: all but unknown offsets.
/// @return whether one was left out that moves, and others remain: the fit is to be repeated
bool Work::LeaveOutSilent() {
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

/// Derivatives, residuals and their colour at the optimum.
bool Work::Conclude() {
  Linearised found = Linearise(model_, optimum_.values, model_.WholeHorizon(), noise_,
                               RecordModel::Difference::kCentral, false, &steps_);
  if (!found.ok) {
    estimation_.message = found.message;
    return false;
  }
  simulated_ = std::move(found.simulated);
  optimum_.jacobian = std::move(found.jacobian);
  optimum_.residuals = std::move(found.residuals);
  Charge("derivatives at the end");
  FindColours();
  return true;
}

/// What is not determined goes back to what was known of it, and the rest is fitted once more;
/// where that fits as well. Of several that the data only see together, what was known may
/// contradict them.
void Work::KeepDefaults(const Determination& determination) {
  bool moved = false;
  const Eigen::VectorXd found = optimum_.values;
  for (int i = 0; i < unknowns_.size(); ++i) {
    const Unknown& u = unknowns_.all()[i];
    if (determination.reasons[i].empty() || !u.start_known || optimum_.values[i] == u.start)
      continue;
    optimum_.values[i] = u.start;
    for (std::size_t e = 0; e < experiments().size(); ++e)
      if (unknowns_.Concerns(i, static_cast<int>(e))) model_.Ignore(i, static_cast<int>(e));
    moved = true;
  }
  if (!moved) return;
  const FitResult fit = Fit(model_, optimum_.values, model_.WholeHorizon(), noise_, {},
                            [&](const std::string& what) { return Tell(what, 0.8); });
  const double before = 0.5 * optimum_.residuals.squaredNorm();
  RecordModel::Simulated kept;
  kept.ok = fit.ok && fit.cost < before + kAsWell;
  if (kept.ok) kept = model_.Simulate({fit.values}, model_.WholeHorizon()).front();
  if (!kept.ok) {
    optimum_.values = found;
    return;
  }
  optimum_.values = fit.values;
  simulated_ = std::move(kept.records);
}

/// Standard deviations to the ends of the 95 % interval: Student's, with the freedom that is left
/// by the estimated scatter's share of the variance (Welch and Satterthwaite).
double Work::QuantileOf(int unknown, const Determination& determination,
                        const Information& information) const {
  if (estimation_.scatter.empty()) return kNormal95;
  std::vector<int> common;
  for (const int i : determination.determined)
    if (unknowns_.all()[i].kind != Unknown::Kind::kScatter) common.push_back(i);
  const double without = CovarianceOf(information, common)(unknown, unknown);
  const double with = determination.covariance(unknown, unknown);
  const double share = with > 0 ? std::max(0.0, 1 - without / with) : 0.0;
  if (!(share > 0)) return kNormal95;
  int freedom = estimation_.scatter.front().freedom;
  for (const ParameterScatter& one : estimation_.scatter) freedom = std::min(freedom, one.freedom);
  return StudentQuantile(freedom / (share * share));
}

void Work::ReportChannels() {
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    const Experiment& experiment = experiments()[e];
    ExperimentFit fit;
    fit.simulated = simulated_[e];
    fit.left_out = model_.IsLeftOut(static_cast<int>(e));
    for (std::size_t c = 0; c < experiment.channels.size(); ++c) {
      const int column = static_cast<int>(c);
      ChannelFit channel;
      channel.column = experiment.channels[c].column;
      channel.sigma = noise_[e][column];
      channel.sigma_given = experiment.channels[c].sigma.has_value();
      channel.rms = Rms(CountedResiduals(experiment, simulated_[e], Counted(e), column));
      channel.correlation_samples = colours_[e][c].correlation_samples;
      channel.noise = Level(e, column);
      if (!model_.IsLeftOut(static_cast<int>(e)))
        Judge(experiment, &channel, &estimation_.warnings);
      fit.channels.push_back(channel);
    }
    estimation_.experiments.push_back(std::move(fit));
  }
}

void Work::Report(const std::vector<ParameterScatter>& scatter) {
  estimation_.scatter = scatter;
  const Information information = InformationOf(model_, optimum_.jacobian, colours_);
  const Determination determination = Determine(model_, optimum_.values, information);
  optimum_.covariance = determination.covariance;
  std::vector<int> shown;
  for (const int i : determination.determined)
    if (unknowns_.all()[i].kind == Unknown::Kind::kCable) shown.push_back(i);
  std::vector<Profile> profiles(shown.size());
  if (options_.profiles && !hurried_ && Tell("profiles of the likelihood", 0.85))
    profiles = FindProfiles(model_, optimum_, noise_, shown);
  Charge("profiles");

  const Eigen::VectorXd fitted = optimum_.values;
  const Eigen::VectorXd sds = determination.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  for (int i = 0; i < unknowns_.size(); ++i) {
    ParameterEstimate estimate;
    estimate.unknown = unknowns_.all()[i];
    estimate.value = fitted[i];
    estimate.determined = determination.reasons[i].empty();
    estimate.reason = determination.reasons[i];
    if (!estimate.determined && ShownByNone(i))
      estimate.reason = "every record that could show [" + estimate.unknown.name +
                        "] was left out: see the warnings";
    if (estimate.determined) {
      estimate.sd = sds[i] * estimate.unknown.scale;
      const double quantile = QuantileOf(i, determination, information);
      estimate.low = estimate.value - quantile * estimate.sd;
      estimate.high = estimate.value + quantile * estimate.sd;
      estimate.quantile = quantile;
      const auto place = std::find(shown.begin(), shown.end(), i);
      if (place != shown.end()) {
        estimate.profile = profiles[static_cast<std::size_t>(place - shown.begin())];
        if (const auto interval = IntervalOf(estimate.profile, estimate.value, estimate.sd)) {
          const double wider = quantile / kNormal95;
          estimate.low = estimate.value + wider * (interval->first - estimate.value);
          estimate.high = estimate.value + wider * (interval->second - estimate.value);
        }
      }
      estimate.low = std::max(estimate.low, estimate.unknown.lower);
    }
    estimation_.parameters.push_back(std::move(estimate));
  }
  const Eigen::VectorXd inverse = sds.unaryExpr([](double sd) { return sd > 0 ? 1 / sd : 0.0; });
  estimation_.correlation = inverse.asDiagonal() * determination.covariance * inverse.asDiagonal();
  estimation_.combinations = determination.combinations;

  if (!hurried_) KeepDefaults(determination);
  for (int i = 0; i < unknowns_.size(); ++i)
    if (!estimation_.parameters[i].determined) estimation_.parameters[i].value = optimum_.values[i];
  Eigen::VectorXd values = optimum_.values;
  for (int i = 0; i < unknowns_.size(); ++i)
    if (estimation_.parameters[i].determined) values[i] = fitted[i];
  estimation_.cable = unknowns_.FilledKeys(values);
  for (const ParameterScatter& one : scatter)
    estimation_.warnings.push_back(
        "[" + one.name + "] differs between the " + std::to_string(one.records) +
        " records that show it by more than their noise: standard deviation " +
        FormatRounded(one.sd) + " " + UnitOf(one.name) + "; the intervals count it");
  ReportChannels();
  estimation_.converged = end_.empty();
  if (!end_.empty())
    estimation_.warnings.push_back("these are the best values so far, and no minimum: " + end_);
  estimation_.ok = true;
  estimation_.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
}

bool Work::FitFromStart() {
  noise_ = GuessNoise(model_);
  std::vector<Eigen::VectorXd> guesses;
  if (!options_.guesses.empty()) {
    Eigen::VectorXd guess = unknowns_.StartValues();
    for (const auto& [name, value] : options_.guesses) {
      const int i = unknowns_.Find(name);
      if (i < 0 || !std::isfinite(value)) continue;
      guess[i] = std::clamp(value, unknowns_.all()[i].lower, unknowns_.all()[i].upper);
    }
    guesses.push_back(guess);
  }
  LeaveOutDamaged();
  const FitProgress early = [&](const std::string& what) { return Tell(what, 0.1); };
  const FitResult start = FitFromAfar(&model_, guesses, noise_, early);
  Charge("search");
  if (!start.ok) {
    estimation_.interrupted = model_.Stopping();
    estimation_.message =
        "no start was found from which the records can be simulated: " + start.message;
    return false;
  }
  optimum_.values = start.values;
  if (start.interrupted) return Hurry();
  LoosenNoise();
  return FitToEnd();
}

/// Where far more than noise is left, that is what weighs the channels: the noise would only say
/// which of them is measured best.
void Work::LoosenNoise() {
  const RecordModel::Simulated found =
      model_.Simulate({optimum_.values}, model_.WholeHorizon()).front();
  if (!found.ok) return;
  const Eigen::VectorXd residuals =
      WeightedResiduals(model_, optimum_.values, found.records, noise_);
  misfit_ = residuals.squaredNorm() > kFarMore * kFarMore * static_cast<double>(residuals.size());
  if (!misfit_) return;
  simulated_ = found.records;
  UpdateNoise();
}

bool Work::FitFrom(const Work& before) {
  noise_ = before.noise_;
  optimum_.values = unknowns_.StartValues();
  for (int i = 0; i < unknowns_.size(); ++i) {
    const int there = before.unknowns_.Find(unknowns_.all()[i].name);
    if (there >= 0) optimum_.values[i] = before.optimum_.values[there];
  }
  for (std::size_t e = 0; e < experiments().size(); ++e)
    if (before.model_.IsLeftOut(static_cast<int>(e))) model_.LeaveOut(static_cast<int>(e));
  estimation_.warnings = before.estimation_.warnings;
  estimation_.stages = before.estimation_.stages;
  begin_ = before.begin_;
  return FitToEnd();
}

bool Settled(const std::vector<ParameterScatter>& before,
             const std::vector<ParameterScatter>& after) {
  return std::equal(before.begin(), before.end(), after.begin(), after.end(),
                    [](const ParameterScatter& a, const ParameterScatter& b) {
                      return a.name == b.name && std::abs(a.sd / b.sd - 1) < kScatterSettled;
                    });
}

}  // namespace

Estimation Estimate(const MeasurementSet& set, const EstimationOptions& given, Problems* problems) {
  // Progress only goes forward, also where a part of the work is done again.
  EstimationOptions options = given;
  double farthest = 0;
  if (given.progress)
    options.progress = [&](const std::string& what, double part) {
      farthest = std::max(farthest, part);
      return given.progress(what, farthest);
    };
  UnknownOptions unknown_options = options.unknowns;
  auto unknowns = std::make_unique<Unknowns>(set, unknown_options, problems);
  if (problems->empty()) {
    // The start must be a cable; what is wrong with it is the user's to know.
    for (std::size_t e = 0; e < set.experiments.size(); ++e)
      unknowns->MakeSpecimen(static_cast<int>(e), unknowns->StartValues(), problems);
  }
  if (problems->empty()) CheckClocks(set, problems);
  if (!problems->empty() || unknowns->size() == 0) {
    Estimation none;
    none.message = problems->empty() ? "the set names nothing to be identified" : "";
    return none;
  }
  auto work = std::make_unique<Work>(*unknowns, options);
  if (!work->FitFromStart()) return work->Answer();
  for (int round = 0;
       round < kScatterRounds && options.scatter && !work->hurried() && !work->misfit(); ++round) {
    const std::vector<ParameterScatter> found = work->Scatter();
    if (Settled(unknown_options.scatter, found)) break;
    unknown_options.scatter = found;
    auto more = std::make_unique<Unknowns>(set, unknown_options, problems);
    auto next = std::make_unique<Work>(*more, options);
    if (!next->FitFrom(*work)) return next->Answer();
    work = std::move(next);
    unknowns = std::move(more);
  }
  work->Report(unknown_options.scatter);
  Estimation estimation = work->Answer();
  if (options.slips && !work->hurried()) {
    estimation.slips = FindSlips(set, estimation, options);
    NameSlips(*unknowns, &estimation);
  }
  return estimation;
}

}  // namespace cosserat_cable
