#include "cosserat_cable/identification/estimation.h"

#include <Eigen/QR>
#include <algorithm>
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
      : unknowns_(unknowns), options_(options), model_(unknowns) {}

  /// False: there is none, and Answer says why.
  bool FitFromStart();
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
  bool Tell(const std::string& what, double part) {
    return !options_.progress || options_.progress(what, part);
  }
  NoiseLevel Level(std::size_t experiment, int column) const;
  bool MovesBeyondNoise(std::size_t experiment) const;
  Eigen::MatrixXd Counted(std::size_t experiment) const;
  bool Sharpen(const Eigen::MatrixXd& jacobian);
  bool ShownByNone(int unknown) const;
  bool UpdateNoise();
  bool FitInRounds();
  bool FitToEnd();
  bool Interrupted() {
    estimation_.interrupted = true;
    return false;
  }
  void LeaveOut(std::size_t experiment, const std::string& why);
  void LeaveOutDamaged();
  void LeaveOutShort();
  bool LeaveOutSilent();
  bool Conclude();
  double QuantileOf(int unknown, const Determination& determination,
                    const Information& information) const;
  void ReportChannels();
  void KeepDefaults(const Determination& determination);

  const Unknowns& unknowns_;
  const EstimationOptions& options_;
  RecordModel model_;
  NoiseLevels noise_;
  Optimum optimum_;
  Records simulated_;
  std::vector<std::vector<NoiseColour>> colours_;
  Estimation estimation_;
  Clock::time_point begin_ = Clock::now();
};

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
bool Work::Sharpen(const Eigen::MatrixXd& jacobian) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(jacobian);
  const Eigen::MatrixXd space =
      qr.householderQ() * Eigen::MatrixXd::Identity(jacobian.rows(), jacobian.cols());
  bool sharper = false;
  Eigen::Index row = 0;
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    const Eigen::MatrixXd error = model_.error()[e].cwiseProduct(SampleWeights(model_, e, noise_));
    const Eigen::Map<const Eigen::VectorXd> column(error.data(), error.size());
    const double shift = (space.middleRows(row, error.size()).transpose() * column).norm();
    row += error.size();
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

bool Work::FitInRounds() {
  FitResult fit;
  bool noise_changed = true;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (!Tell("comparing with finer steps", kPartOfStart + kPartOfRound * round))
      return Interrupted();
    estimation_.discretisation = model_.Refine(optimum_.values);
    const Eigen::VectorXd before = optimum_.values;
    const bool polished = !noise_changed && Polish(model_, fit.jacobian, noise_, &optimum_.values);
    if (!polished) {
      const FitProgress progress = [&](const std::string& what) {
        return Tell("fitting whole records, " + what, kPartOfStart + kPartOfRound * (round + 0.5));
      };
      fit = Fit(model_, optimum_.values, model_.WholeHorizon(), noise_, {}, progress);
      if (fit.interrupted) return Interrupted();
      if (!fit.ok) {
        estimation_.message = "the fit does not converge: " + fit.message;
        return false;
      }
      optimum_.values = fit.values;
    }
    simulated_ = model_.Simulate({optimum_.values}, model_.WholeHorizon()).front().records;
    noise_changed = UpdateNoise();
    // Against the standard deviations of the unknowns by themselves: the strictest measure.
    double moved = 0;
    for (int i = 0; i < unknowns_.size(); ++i)
      moved = std::max(moved, std::abs(optimum_.values[i] - before[i]) / unknowns_.all()[i].scale *
                                  fit.jacobian.col(i).norm());
    const bool sharper = Sharpen(fit.jacobian);
    if (round > 0 && !noise_changed && !sharper && moved < kSettled) break;
  }
  return true;
}

bool Work::FitToEnd() {
  if (!FitInRounds()) return false;
  LeaveOutShort();
  // What was left out has pulled at the rest until now.
  if (LeaveOutSilent() && !FitInRounds()) return false;
  if (Conclude()) return true;
  estimation_.interrupted = estimation_.message.empty();
  return false;
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
  const RecordModel::Derivatives found = model_.Differentiate(
      optimum_.values, model_.WholeHorizon(), RecordModel::Difference::kCentral);
  if (!found.at.ok) {
    estimation_.message = found.at.message;
    return false;
  }
  simulated_ = found.at.records;
  optimum_.jacobian = WeightedJacobian(model_, found, noise_);
  optimum_.residuals = WeightedResiduals(model_, optimum_.values, simulated_, noise_);
  colours_.clear();
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    colours_.emplace_back();
    for (int c = 0; c < static_cast<int>(experiments()[e].channels.size()); ++c)
      colours_.back().push_back(ColourOf(
          CountedResiduals(experiments()[e], simulated_[e], Counted(e), c) / noise_[e][c]));
  }
  return true;
}

/// What is not determined goes back to what was known of it, and the rest is fitted once more.
void Work::KeepDefaults(const Determination& determination) {
  bool moved = false;
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
  if (!fit.ok) return;
  optimum_.values = fit.values;
  simulated_ = model_.Simulate({fit.values}, model_.WholeHorizon()).front().records;
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
  // A start is far from what one step of the profile mends: the interval would be far too narrow.
  const bool starts_unknown =
      std::any_of(unknowns_.all().begin(), unknowns_.all().end(), [](const Unknown& one) {
        return one.kind == Unknown::Kind::kSwing || one.kind == Unknown::Kind::kSpeed;
      });
  if (options_.profiles && !starts_unknown && Tell("profiles of the likelihood", 0.85))
    profiles = FindProfiles(model_, optimum_, noise_, shown);

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
        if (const auto interval = IntervalOf(estimate.profile, estimate.value)) {
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

  KeepDefaults(determination);
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
  if (!start.ok) {
    estimation_.interrupted = start.interrupted;
    estimation_.message =
        "no start was found from which the records can be simulated: " + start.message;
    return false;
  }
  optimum_.values = start.values;
  return FitToEnd();
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

Estimation Estimate(const MeasurementSet& set, const EstimationOptions& options,
                    Problems* problems) {
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
  for (int round = 0; round < kScatterRounds && options.scatter; ++round) {
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
  if (options.slips) {
    estimation.slips = FindSlips(set, estimation, options);
    NameSlips(*unknowns, &estimation);
  }
  return estimation;
}

}  // namespace cosserat_cable
