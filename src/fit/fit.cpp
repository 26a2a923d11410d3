#include "cosserat_cable/fit/fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/fit/noise.h"
#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/rod/rod_batch.h"
#include "least_squares.h"

namespace cosserat_cable {
namespace {

constexpr int kMaxIterations = 40;
constexpr int kLooseIterations = 12;
// What ends a fit: a gain, by the noise's variance, that moves no parameter by a tenth of its
// standard deviation; on the way, this part of the samples.
constexpr double kSmallGain = 5e-3, kLoose = 1e-3;
// The same where what is left is no noise: its parts depend on each other for long.
constexpr double kOfMisfit = 1e-4;
// Half the square of the standard deviations that a parameter may be off where steps gain nothing
// any more: rounding and what is left of the steps in time hide as much.
constexpr double kHidden = 0.125;
// Of the differences, in the unknowns' scales; what they should do to a record, in parts of its
// noise, so that they are neither rounding nor bent; below which part of that, and by which factor
// in the step, it is worth another try.
constexpr double kSmallestStep = 1e-6, kLargestStep = 0.03, kEffect = 0.3;
constexpr double kFaintEffect = 0.01, kCoarser = 10;
// The largest factor of a stiffness in one iteration.
constexpr double kFarthest = 5;
// No channel is taken to be better than this part of the widest range of its kind in its record:
// simulations are not.
constexpr double kBestChannel = 1e-7;
// Steps with old derivatives; the gain in the sum of squares that is not worth another, and the
// loss that rounding may make.
constexpr int kPolishSteps = 6;
constexpr double kPolished = 1e-4, kPolishNoise = 1e-2;

/// Half the sums of squares, infinite where a simulation failed.
std::vector<double> CostsOf(const RecordModel& model, const std::vector<Eigen::VectorXd>& points,
                            const std::vector<RecordModel::Simulated>& found,
                            const NoiseLevels& noise) {
  std::vector<double> costs;
  for (std::size_t p = 0; p < points.size(); ++p) {
    costs.push_back(std::numeric_limits<double>::infinity());
    if (!found[p].ok) continue;
    const double cost =
        0.5 * WeightedResiduals(model, points[p], found[p].records, noise).squaredNorm();
    if (std::isfinite(cost)) costs.back() = cost;
  }
  return costs;
}

/// By unknown, whether it concerns one experiment only.
std::vector<bool> ConcernOne(const Unknowns& unknowns) {
  std::vector<bool> which;
  for (const Unknown& u : unknowns.all()) which.push_back(u.experiment >= 0);
  return which;
}

/// Whether derivatives serve longer than where they were found: on the way, or those of a fit
/// before.
bool KeepsDerivatives(const FitOptions& fit) { return fit.loose || !fit.known.records().empty(); }

/// All records, by the unknowns' variables.
class RecordProblem : public LeastSquaresProblem {
 public:
  RecordProblem(const RecordModel& model, const Horizon& horizon, const NoiseLevels& noise,
                const FitProgress& progress, const FitOptions& fit, double samples)
      : model_(model),
        horizon_(horizon),
        noise_(noise),
        progress_(progress),
        samples_(samples),
        steps_(fit.steps),
        keeps_(KeepsDerivatives(fit)),
        jacobian_(fit.known) {
    first_ = steps_.size() == 0;
    if (first_) steps_ = model.SmallSteps();
  }

  Linearisation Linearise(const Eigen::VectorXd& x, const std::vector<Eigen::VectorXd>& others,
                          Renew renew, std::vector<double>* costs) override {
    if (renew == Renew::kNone)
      for (const Tried& one : tried_)
        if (one.x == x) return MovedTo(one);
    std::vector<Eigen::VectorXd> beside;
    for (const Eigen::VectorXd& other : others) beside.push_back(ValuesOf(other));
    RecordJacobian known;
    // What concerns one experiment only changes least on the way, and there is much of it.
    if (renew == Renew::kSome) known = jacobian_.Only(ConcernOne(model_.unknowns()));
    if (renew == Renew::kNone) known = jacobian_;
    Linearised found = cosserat_cable::Linearise(model_, ValuesOf(x), horizon_, noise_,
                                                 RecordModel::Difference::kForward, first_, &steps_,
                                                 beside, &known);
    *costs = found.other_costs;
    message_ = found.message;
    if (!found.ok) return {};
    first_ = false;
    jacobian_ = std::move(found.jacobian);
    is_whole_ = found.whole;
    return At({x, std::move(found.residuals)}, renew == Renew::kNone && !found.whole);
  }

  std::vector<double> Costs(const std::vector<Eigen::VectorXd>& points) override {
    std::vector<Eigen::VectorXd> all;
    for (const Eigen::VectorXd& x : points) all.push_back(ValuesOf(x));
    const std::vector<RecordModel::Simulated> found = model_.Simulate(all, horizon_);
    std::vector<double> costs;
    tried_.clear();
    for (std::size_t p = 0; p < points.size(); ++p) {
      costs.push_back(std::numeric_limits<double>::infinity());
      if (!found[p].ok) continue;
      Tried one{points[p], WeightedResiduals(model_, all[p], found[p].records, noise_)};
      if (!one.residuals.allFinite()) continue;
      costs.back() = 0.5 * one.residuals.squaredNorm();
      tried_.push_back(std::move(one));
    }
    return costs;
  }

  int SideBySide() const override { return rod::RodBatch::PreferredRods(); }
  int Room() const override {
    // What the differences leave of the lanes, or as many lanes more.
    const int lanes = rod::RodBatch::PreferredRods();
    const std::vector<bool> kept = keeps_ ? ConcernOne(model_.unknowns()) : std::vector<bool>();
    return lanes - 1 - model_.MostShown(kept) % lanes;
  }

  bool GoOn(int iteration, double cost) override {
    if (model_.Stopping()) return false;
    const double times_noise = std::sqrt(2 * cost / std::max(samples_, 1.0));
    return !progress_ || progress_("iteration " + std::to_string(iteration) + ", " +
                                   FormatRounded(times_noise, 2) + " times the noise");
  }

  /// No stiffness changes by more than a factor in one step: derivatives do not reach farther. What
  /// may vanish comes nearer to nothing by as much at most, and grows as it likes.
  void Restrain(const Eigen::VectorXd& x, Eigen::VectorXd* next) const override {
    for (int i = 0; i < x.size(); ++i) {
      const Unknown& u = Of(i);
      if (u.kind != Unknown::Kind::kCable || u.damping || !(x[i] > 0)) continue;
      if (u.sign == ParameterSign::kSigned) continue;
      double& to = (*next)[i];
      if (u.scaling == Unknown::Scaling::kLogarithmic) {
        to = std::clamp(to, x[i] - std::log(kFarthest), x[i] + std::log(kFarthest));
        continue;
      }
      to = std::max(to, x[i] / kFarthest);
      const bool linear = u.scaling == Unknown::Scaling::kLinear;
      if (linear && u.sign == ParameterSign::kPositive) to = std::min(to, x[i] * kFarthest);
    }
  }

  const RecordJacobian& jacobian() const { return jacobian_; }
  bool IsJacobianAt(const Eigen::VectorXd& x) const { return is_whole_ && last_.x == x; }
  const Eigen::VectorXd& steps() const { return steps_; }
  const std::string& message() const { return message_; }

  Eigen::VectorXd ValuesOf(const Eigen::VectorXd& x) const {
    Eigen::VectorXd values(x.size());
    for (int i = 0; i < x.size(); ++i) values[i] = ValueOf(Of(i), x[i]);
    return values;
  }
  Eigen::VectorXd VariablesOf(const Eigen::VectorXd& values) const {
    Eigen::VectorXd x(values.size());
    for (int i = 0; i < x.size(); ++i) x[i] = VariableOf(Of(i), values[i]);
    return x;
  }

 private:
  struct Tried {
    Eigen::VectorXd x, residuals;
  };

  /// The derivatives are those of the last place, corrected by the way from there.
  Linearisation MovedTo(const Tried& here) {
    Eigen::VectorXd step = ValuesOf(here.x) - ValuesOf(last_.x);
    for (int i = 0; i < step.size(); ++i) step[i] /= Of(i).scale;
    jacobian_.Correct(step, here.residuals - last_.residuals);
    is_whole_ = false;
    return At(here, true);
  }

  Linearisation At(Tried here, bool kept) {
    Linearisation at;
    at.ok = true;
    at.whole = is_whole_;
    at.kept = kept;
    at.cost = 0.5 * here.residuals.squaredNorm();
    at.gram = jacobian_.Gram();
    at.gradient = jacobian_.TransposeTimes(here.residuals);
    // What no record shows is left alone: its derivatives are rounding.
    const Eigen::VectorXd seen = jacobian_.SquaredNorms();
    for (int i = 0; i < seen.size(); ++i)
      if (seen[i] < kUnseen && jacobian_.priors()[i] == 0) at.gram(i, i) = 0;
    for (int i = 0; i < seen.size(); ++i) {
      const double slope = VariableSlope(Of(i), here.x[i]);
      if (slope == 1) continue;
      at.gram.row(i) *= slope;
      at.gram.col(i) *= slope;
      at.gradient[i] *= slope;
    }
    last_ = std::move(here);
    return at;
  }

  const Unknown& Of(int i) const { return model_.unknowns().all()[static_cast<std::size_t>(i)]; }

  const RecordModel& model_;
  const Horizon& horizon_;
  const NoiseLevels& noise_;
  const FitProgress& progress_;
  double samples_;
  Eigen::VectorXd steps_;
  bool first_ = true;
  bool keeps_;  // derivatives on the way
  RecordJacobian jacobian_;
  Tried last_;  // where it is
  bool is_whole_ = false;
  std::vector<Tried> tried_;
  std::string message_;
};

int SamplesUntil(const Experiment& experiment, double time) {
  const std::vector<double>& t = experiment.record.t;
  return static_cast<int>(std::upper_bound(t.begin(), t.end(), time) - t.begin());
}

}  // namespace

double SmallestNoise(const Experiment& experiment, int channel) {
  const auto& channels = experiment.channels;
  double widest = 0;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (channels[c].quantity != channels[static_cast<std::size_t>(channel)].quantity) continue;
    const auto column = experiment.record.values.col(static_cast<Eigen::Index>(c));
    widest = std::max(widest, column.maxCoeff() - column.minCoeff());
  }
  return std::max(kBestChannel * widest, std::numeric_limits<double>::min() * 1e10);
}

NoiseLevels GuessNoise(const RecordModel& model) {
  NoiseLevels noise;
  for (const Experiment& experiment : model.unknowns().set().experiments) {
    const Eigen::MatrixXd& values = experiment.record.values;
    const Eigen::MatrixXd& usable = model.usable()[noise.size()];
    Eigen::VectorXd levels(values.cols());
    for (Eigen::Index c = 0; c < values.cols(); ++c) {
      const auto& sigma = experiment.channels[static_cast<std::size_t>(c)].sigma;
      levels[c] = std::max(sigma ? *sigma : NoiseOfSmooth(values.col(c), usable.col(c)),
                           SmallestNoise(experiment, static_cast<int>(c)));
    }
    noise.push_back(levels);
  }
  return noise;
}

Eigen::MatrixXd SampleWeights(const RecordModel& model, std::size_t e, const NoiseLevels& noise) {
  Eigen::MatrixXd weights = model.usable()[e];
  for (Eigen::Index c = 0; c < weights.cols(); ++c)
    for (Eigen::Index i = 0; i < weights.rows(); ++i)
      weights(i, c) /= std::hypot(noise[e][c], model.error()[e](i, c));
  return weights;
}

int FirstRow(const RecordModel& model, int experiment) {
  int row = 0;
  for (int e = 0; e < experiment; ++e)
    row += static_cast<int>(model.usable()[static_cast<std::size_t>(e)].size());
  return row;
}

Eigen::VectorXd WeightedResiduals(const RecordModel& model, const Eigen::VectorXd& values,
                                  const Records& simulated, const NoiseLevels& noise) {
  const auto& experiments = model.unknowns().set().experiments;
  std::vector<double> residuals;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const Eigen::MatrixXd weights = SampleWeights(model, e, noise);
    for (int c = 0; c < simulated[e].cols(); ++c)
      for (int i = 0; i < simulated[e].rows(); ++i)
        residuals.push_back(weights(i, c) *
                            (experiments[e].record.values(i, c) - simulated[e](i, c)));
  }
  for (int i = 0; i < model.unknowns().size(); ++i) {
    const Unknown& u = model.unknowns().all()[i];
    if (u.prior_sd > 0) residuals.push_back((u.start - values[i]) / u.prior_sd);
  }
  return Eigen::Map<Eigen::VectorXd>(residuals.data(), static_cast<int>(residuals.size()));
}

RecordJacobian WeightedJacobian(const RecordModel& model,
                                const RecordModel::Derivatives& derivatives,
                                const NoiseLevels& noise) {
  std::vector<RecordJacobian::Record> records;
  for (std::size_t e = 0; e < derivatives.slopes.size(); ++e) {
    const auto& slopes = derivatives.slopes[e];
    const Eigen::MatrixXd& shown = derivatives.at.records[e];
    const Eigen::MatrixXd weights = SampleWeights(model, e, noise).topRows(shown.rows());
    RecordJacobian::Record record;
    record.columns.resize(shown.size(), static_cast<Eigen::Index>(slopes.size()));
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      record.unknowns.push_back(slopes[k].unknown);
      const Eigen::MatrixXd weighted = -slopes[k].by.cwiseProduct(weights);
      record.columns.col(static_cast<Eigen::Index>(k)) =
          Eigen::Map<const Eigen::VectorXd>(weighted.data(), weighted.size());
    }
    records.push_back(std::move(record));
  }
  Eigen::VectorXd priors = Eigen::VectorXd::Zero(model.unknowns().size());
  for (int i = 0; i < priors.size(); ++i) {
    const Unknown& u = model.unknowns().all()[i];
    if (u.prior_sd > 0) priors[i] = -u.scale / u.prior_sd;
  }
  return RecordJacobian(std::move(records), priors);
}

Linearised Linearise(const RecordModel& model, const Eigen::VectorXd& values,
                     const Horizon& horizon, const NoiseLevels& noise,
                     RecordModel::Difference difference, bool again, Eigen::VectorXd* steps,
                     const std::vector<Eigen::VectorXd>& others, const RecordJacobian* known) {
  Linearised result;
  std::vector<bool> left_out;
  if (known) left_out = known->Known();
  result.whole = std::count(left_out.begin(), left_out.end(), true) == 0;
  RecordModel::Derivatives found =
      model.Differentiate(values, horizon, difference, *steps, others, left_out);
  result.other_costs = CostsOf(model, others, found.others, noise);
  for (;; again = false) {
    result.ok = found.at.ok;
    result.message = found.at.message;
    if (!result.ok) return result;
    result.jacobian = WeightedJacobian(model, found, noise);
    if (!result.whole) result.jacobian.Add(*known, left_out);
    bool unsuitable = false;
    for (int i = 0; i < steps->size(); ++i) {
      // In the record that shows it most: the root of the mean square of what the step does.
      double effect = 0;
      for (const RecordJacobian::Record& record : result.jacobian.records())
        for (std::size_t k = 0; k < record.unknowns.size(); ++k)
          if (record.unknowns[k] == i)
            effect = std::max(effect, (*steps)[i] *
                                          record.columns.col(static_cast<Eigen::Index>(k)).norm() /
                                          std::sqrt(static_cast<double>(record.columns.rows())));
      const double wanted =
          std::clamp((*steps)[i] * kEffect / std::max(effect, 1e-300), kSmallestStep, kLargestStep);
      unsuitable |= effect < kFaintEffect * kEffect && wanted > kCoarser * (*steps)[i];
      (*steps)[i] = wanted;
    }
    if (!again || !unsuitable) break;
    found = model.Differentiate(values, horizon, difference, *steps, {}, left_out);
  }
  result.simulated = std::move(found.at.records);
  result.residuals = WeightedResiduals(model, values, result.simulated, noise);
  return result;
}

FitResult Fit(const RecordModel& model, const Eigen::VectorXd& values, const Horizon& horizon,
              const NoiseLevels& noise, const FitOptions& fit, const FitProgress& progress) {
  const Unknowns& unknowns = model.unknowns();
  LeastSquaresOptions options;
  options.samples = 0;
  for (std::size_t e = 0; e < horizon.size(); ++e) {
    const Experiment& experiment = unknowns.set().experiments[e];
    options.samples +=
        SamplesUntil(experiment, horizon[e]) * static_cast<double>(experiment.channels.size());
  }
  RecordProblem problem(model, horizon, noise, progress, fit, options.samples);
  options.lower.resize(unknowns.size());
  options.upper.resize(unknowns.size());
  for (int i = 0; i < unknowns.size(); ++i) {
    const Unknown& u = unknowns.all()[i];
    const double at_lower = VariableOf(u, u.lower), at_upper = VariableOf(u, u.upper);
    options.lower[i] = std::min(at_lower, at_upper);
    options.upper[i] = std::max(at_lower, at_upper);
  }
  options.held.assign(static_cast<std::size_t>(unknowns.size()), false);
  for (const int i : fit.held) options.held[static_cast<std::size_t>(i)] = true;
  options.max_iterations = fit.max_iterations > 0 ? fit.max_iterations
                           : fit.loose            ? kLooseIterations
                                                  : kMaxIterations;
  // On the way, what changes the misfit by a small part is not worth an iteration either.
  const double by_sample = fit.loose ? kLoose : fit.to_noise ? 0 : kOfMisfit;
  options.small_gain = std::max(kSmallGain, by_sample * options.samples);
  options.aim = fit.aim;
  options.finish = fit.finish;
  if (KeepsDerivatives(fit))
    options.renew =
        fit.quick ? LeastSquaresProblem::Renew::kNone : LeastSquaresProblem::Renew::kSome;
  const LeastSquaresResult found = Minimise(problem.VariablesOf(values), options, &problem);

  FitResult result;
  result.interrupted = found.end == LeastSquaresResult::End::kStopped || model.Stopping();
  result.ok = found.end != LeastSquaresResult::End::kFailed;
  result.at_minimum = found.end == LeastSquaresResult::End::kMinimum ||
                      (found.end == LeastSquaresResult::End::kStuck && found.gain_left < kHidden);
  result.is_far = found.end == LeastSquaresResult::End::kFar;
  result.message = problem.message();
  result.cost = found.cost;
  result.gain_left = found.gain_left;
  result.iterations = found.iterations;
  result.values = problem.ValuesOf(found.x);
  result.jacobian = problem.jacobian();
  result.is_jacobian = problem.IsJacobianAt(found.x);
  result.steps = problem.steps();
  return result;
}

bool Polish(const RecordModel& model, const RecordJacobian& jacobian, const NoiseLevels& noise,
            Eigen::VectorXd* values) {
  const Unknowns& unknowns = model.unknowns();
  Eigen::VectorXd best = *values, relative = *values;
  for (int i = 0; i < unknowns.size(); ++i) relative[i] /= unknowns.all()[i].scale;
  Eigen::MatrixXd gram = jacobian.Gram();
  gram.diagonal() += Ties(relative, 1);
  const Eigen::LDLT<Eigen::MatrixXd> solve(gram);
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step <= kPolishSteps; ++step) {
    const RecordModel::Simulated found = model.Simulate({best}, model.WholeHorizon()).front();
    if (!found.ok) return false;
    const Eigen::VectorXd residuals = WeightedResiduals(model, best, found.records, noise);
    const double cost = residuals.squaredNorm();
    if (cost > least + kPolishNoise) return false;
    least = std::min(least, cost);
    *values = best;
    const Eigen::VectorXd gradient = jacobian.TransposeTimes(residuals);
    const Eigen::VectorXd move = -solve.solve(gradient);
    if (-gradient.dot(move) < kPolished) return true;
    for (int i = 0; i < unknowns.size(); ++i) {
      const Unknown& u = unknowns.all()[i];
      best[i] = std::clamp(best[i] + move[i] * u.scale, u.lower, u.upper);
    }
  }
  return false;
}

}  // namespace cosserat_cable
