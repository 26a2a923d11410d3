#include "estimation_work.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/fit/step_errors.h"
#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

constexpr int kMaxRounds = 6;
// A further round of steps, noise and fit is worth it where values moved by more than this part of
// their standard deviation, or a noise by this part.
constexpr double kSettled = 0.1, kNoiseSettled = 0.05;
// The part of the noise below which the simulation's remaining error in a sample is none.
constexpr double kResolved = 0.5;
// Times the noise.
constexpr double kFarMore = 30;
// Of the whole work: what is done when the records are fitted as a whole, and what a round adds.
constexpr double kPartOfStart = 0.35, kPartOfRound = 0.08;

/// Derivatives of the records' beginnings as those of the whole, which say nothing of the rest.
RecordJacobian OfWholeRecords(const RecordJacobian& beginnings,
                              const std::vector<Experiment>& experiments, int unknowns) {
  std::vector<RecordJacobian::Record> records(experiments.size());
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const Eigen::MatrixXd& values = experiments[e].record.values;
    records[e].columns.resize(values.size(), 0);
    if (e >= beginnings.records().size()) continue;
    const RecordJacobian::Record& part = beginnings.records()[e];
    records[e].unknowns = part.unknowns;
    records[e].columns = Eigen::MatrixXd::Zero(values.size(), part.columns.cols());
    const Eigen::Index samples = part.columns.rows() / values.cols();
    for (Eigen::Index c = 0; c < values.cols(); ++c)
      records[e].columns.middleRows(c * values.rows(), samples) =
          part.columns.middleRows(c * samples, samples);
  }
  const bool has_priors = beginnings.priors().size() == unknowns;
  return RecordJacobian(std::move(records),
                        has_priors ? beginnings.priors() : Eigen::VectorXd::Zero(unknowns).eval());
}

}  // namespace

Eigen::VectorXd CountedResiduals(const Experiment& experiment, const Eigen::MatrixXd& simulated,
                                 const Eigen::MatrixXd& count, int column) {
  std::vector<double> residuals;
  for (Eigen::Index i = 0; i < simulated.rows(); ++i)
    if (count(i, column) > 0)
      residuals.push_back(experiment.record.values(i, column) - simulated(i, column));
  return Eigen::Map<Eigen::VectorXd>(residuals.data(), static_cast<Eigen::Index>(residuals.size()));
}

/// One for samples that a sensor measured and the simulation resolves; all that were measured where
/// it hardly resolves any.
Eigen::MatrixXd EstimationWork::Counted(std::size_t e) const {
  Eigen::MatrixXd counted = model_.usable()[e];
  for (Eigen::Index c = 0; c < counted.cols(); ++c) {
    const auto resolved =
        (model_.error()[e].col(c).array().abs() < kResolved * noise_[e][c]).cast<double>();
    if (2 * resolved.sum() > static_cast<double>(counted.rows()))
      counted.col(c).array() *= resolved;
  }
  return counted;
}

/// Where the noise is not given, the residuals say what it is. False: it had been right.
bool EstimationWork::UpdateNoise() {
  bool changed = false;
  for (std::size_t e = 0; e < experiments().size(); ++e)
    for (std::size_t c = 0; c < experiments()[e].channels.size(); ++c) {
      if (experiments()[e].channels[c].sigma) continue;
      const int column = static_cast<int>(c);
      const double rms = std::max(
          RootMeanSquare(CountedResiduals(experiments()[e], simulated_[e], Counted(e), column)),
          SmallestNoise(experiments()[e], column));
      changed |= std::abs(rms / noise_[e][column] - 1) > kNoiseSettled;
      noise_[e][column] = rms;
    }
  return changed;
}

/// The last fit's derivatives, where they are of whole records.
RecordJacobian EstimationWork::KnownOfWhole() const {
  const auto& records = fit_.jacobian.records();
  if (records.size() != experiments().size()) return {};
  for (std::size_t e = 0; e < records.size(); ++e)
    if (records[e].columns.rows() != experiments()[e].record.values.size()) return {};
  return fit_.jacobian;
}

/// False: stopped, or there is no fit and `message` says why.
bool EstimationWork::FitInRounds() {
  bool noise_changed = true;
  double last_move = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (!Tell("comparing with finer steps", kPartOfStart + kPartOfRound * round)) return false;
    estimation_.discretisation = model_.Refine(optimum_.values, noise_);
    clock_->Charge("steps in space and time");
    const Eigen::VectorXd before = optimum_.values;
    const FitProgress progress = [&](const std::string& what) {
      return Tell("fitting whole records, " + what, kPartOfStart + kPartOfRound * (round + 0.5));
    };
    if (noise_changed || !Polish(model_, fit_.jacobian, noise_, &optimum_.values)) {
      FitOptions options;
      options.steps = fit_.steps;
      options.known = KnownOfWhole();
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
    clock_->Charge("fit");
    const RecordModel::Simulated found =
        model_.Simulate({optimum_.values}, model_.WholeHorizon()).front();
    if (!found.ok) return false;
    simulated_ = found.records;
    noise_changed = UpdateNoise();
    // In standard deviations, over all unknowns together.
    Eigen::VectorXd moved_by = optimum_.values - before;
    for (int i = 0; i < unknowns_.size(); ++i) moved_by[i] /= unknowns_.all()[i].scale;
    const double moved = std::sqrt(moved_by.dot(fit_.jacobian.Gram() * moved_by));
    const bool sharper = !misfit_ && SharpenWhereItMoves(fit_.jacobian, noise_, &model_);
    // Corrections follow the values, and the values the corrections: by the same part each time.
    const double next = last_move > moved ? moved * moved / last_move : moved;
    last_move = moved;
    if (round > 0 && (misfit_ || (!noise_changed && !sharper && next < kSettled))) break;
  }
  end_ = fit_.at_minimum ? ""
                         : "no step gains anything, although the derivatives put the minimum " +
                               FormatRounded(std::sqrt(2 * fit_.gain_left), 2) +
                               " standard deviations away: the records' misfit is rough";
  return true;
}

bool EstimationWork::FitToEnd() {
  if (!FitInRounds()) return Hurry();
  LeaveOutShort();
  // What was left out has pulled at the rest until now.
  if (LeaveOutSilent() && !FitInRounds()) return Hurry();
  return Conclude() || Hurry();
}

/// Ends with what was found so far, as fast as it can. False: nothing was found, or there was no
/// hurry, and `message` says why.
bool EstimationWork::Hurry() {
  if (!model_.Stopping()) return false;
  estimation_.interrupted = Stopped();
  model_.SetStop(nullptr);
  hurried_ = true;
  estimation_.message.clear();
  end_ = estimation_.interrupted
             ? "interrupted"
             : "the time budget of " + FormatRounded(options_.time_budget) + " s is spent";
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
  const bool whole = rows == FirstRow(model_, static_cast<int>(experiments().size()));
  if (!whole && estimation_.interrupted) {
    // Nobody waits for new ones: what the beginnings of the records say is less, and true.
    optimum_.jacobian = OfWholeRecords(fit_.jacobian, experiments(), unknowns_.size());
  } else if (!whole) {
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
  clock_->Charge("derivatives at the end");
  return true;
}

void EstimationWork::FindColours() {
  colours_.clear();
  for (std::size_t e = 0; e < experiments().size(); ++e) {
    colours_.emplace_back();
    for (int c = 0; c < static_cast<int>(experiments()[e].channels.size()); ++c)
      colours_.back().push_back(ColourOf(
          CountedResiduals(experiments()[e], simulated_[e], Counted(e), c) / noise_[e][c]));
  }
}

/// Derivatives, residuals and their colour at the optimum.
bool EstimationWork::Conclude() {
  Linearised found = Linearise(model_, optimum_.values, model_.WholeHorizon(), noise_,
                               RecordModel::Difference::kCentral, false, &steps_);
  if (!found.ok) {
    estimation_.message = found.message;
    return false;
  }
  simulated_ = std::move(found.simulated);
  optimum_.jacobian = std::move(found.jacobian);
  optimum_.residuals = std::move(found.residuals);
  FindColours();
  clock_->Charge("derivatives at the end");
  return true;
}

bool EstimationWork::FitFromStart() {
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
  clock_->Charge("noise of the records");
  const FitProgress early = [&](const std::string& what) { return Tell(what, 0.1); };
  const FitResult start = FitFromAfar(&model_, guesses, noise_, early, &rival_);
  clock_->Charge("search");
  if (!start.ok) {
    estimation_.interrupted = model_.Stopping();
    estimation_.message =
        "no start was found from which the records can be simulated: " + start.message;
    return false;
  }
  optimum_.values = start.values;
  fit_ = start;
  if (start.interrupted) return Hurry();
  LoosenNoise();
  return FitToEnd();
}

/// Where far more than noise is left, that is what weighs the channels: the noise would only say
/// which of them is measured best.
void EstimationWork::LoosenNoise() {
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

bool EstimationWork::FitFrom(const EstimationWork& before) {
  noise_ = before.noise_;
  const auto as_here = [&](const Eigen::VectorXd& values) {
    Eigen::VectorXd here = unknowns_.StartValues();
    for (int i = 0; i < unknowns_.size(); ++i) {
      const int there = before.unknowns_.Find(unknowns_.all()[i].name);
      if (there >= 0) here[i] = values[there];
    }
    return here;
  };
  optimum_.values = as_here(before.optimum_.values);
  rival_ = before.rival_;
  if (rival_.ok) rival_.values = as_here(before.rival_.values);
  for (std::size_t e = 0; e < experiments().size(); ++e)
    if (before.model_.IsLeftOut(static_cast<int>(e))) model_.LeaveOut(static_cast<int>(e));
  estimation_.warnings = before.estimation_.warnings;
  return FitToEnd();
}

}  // namespace cosserat_cable
