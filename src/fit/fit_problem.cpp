#include "cosserat_cable/fit/fit_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cosserat_cable/fit/damage.h"
#include "cosserat_cable/fit/noise.h"
#include "cosserat_cable/fit/step_errors.h"

namespace cosserat_cable {
namespace {

// Mean square of the residuals, in the noise's variance, above which what is left is no noise.
constexpr double kMuchNoise = 4;
// Of a record whose start is unknown: what its prediction is begun with, in periods and as a part.
constexpr double kBeginningPeriods = 2;
// Squared norm of a derivative, over the unknown's scale, that shows something of it.
constexpr double kShown = 1e-3;
// The part of a parameter's value by which a fit may begin elsewhere, with the derivatives of
// there.
constexpr double kNear = 0.1;
// Runs with finer steps, each followed by a fit.
constexpr int kRounds = 2;

}  // namespace

SetNoise NoiseOf(const MeasurementSet& set, const Records& simulated) {
  SetNoise noise;
  for (std::size_t e = 0; e < set.experiments.size(); ++e) {
    const Experiment& experiment = set.experiments[e];
    const Eigen::MatrixXd usable = UsableSamples(experiment.record);
    Eigen::VectorXd levels(static_cast<Eigen::Index>(experiment.channels.size()));
    noise.sources.emplace_back();
    for (int c = 0; c < static_cast<int>(levels.size()); ++c) {
      const NoiseLevel level = e < simulated.size()
                                   ? LevelOf(experiment, c, usable.col(c), simulated[e].col(c))
                                   : LevelOf(experiment, c, usable.col(c));
      // An upper bound serves: what is more than that is no noise.
      const bool known = level.source != NoiseLevel::Source::kUnknown || level.sd > 0;
      noise.known = noise.known && known;
      const double sd =
          known ? level.sd : NoiseOfSmooth(experiment.record.values.col(c), usable.col(c));
      levels[c] = std::max(sd, SmallestNoise(experiment, c));
      noise.sources.back().push_back(level);
    }
    noise.levels.push_back(levels);
  }
  return noise;
}

double FitPoint::ValueOf(const std::string& name) const {
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].name == name) return values[static_cast<Eigen::Index>(i)];
  return std::numeric_limits<double>::quiet_NaN();
}

Likelihood LikelihoodOf(const FitPoint& point) {
  Likelihood all;
  for (std::size_t e = 0; e < point.residuals.size(); ++e) {
    const Eigen::MatrixXd& residuals = point.residuals[e];
    all.whitened.push_back(Eigen::MatrixXd::Zero(residuals.rows(), residuals.cols()));
    for (Eigen::Index c = 0; c < residuals.cols(); ++c) {
      // Exactly zero is what no sensor measured.
      std::vector<Eigen::Index> counted;
      for (Eigen::Index i = 0; i < residuals.rows(); ++i)
        if (residuals(i, c) != 0) counted.push_back(i);
      if (counted.empty()) continue;
      Eigen::VectorXd column(static_cast<Eigen::Index>(counted.size()));
      for (std::size_t k = 0; k < counted.size(); ++k)
        column[static_cast<Eigen::Index>(k)] = residuals(counted[k], c);
      const NoiseColour colour = ColourOf(column);
      const Whitened white = Whiten(column, colour, 1.0);
      const double count = static_cast<double>(counted.size());
      all.log_likelihood += white.log_likelihood - count * std::log(point.noise[e][c]);
      all.samples += count / std::max(1.0, colour.correlation_samples);
      for (std::size_t k = 0; k < counted.size(); ++k)
        all.whitened[e](counted[k], c) = white.residuals[static_cast<Eigen::Index>(k)];
    }
  }
  const Eigen::VectorXd shown = point.jacobian.SquaredNorms();
  all.freedom = all.samples - static_cast<double>((shown.array() > kShown).count());
  return all;
}

FitProblem::FitProblem(const MeasurementSet& set, const FitProblemOptions& options,
                       Problems* problems)
    : options_(options),
      unknowns_(std::make_unique<Unknowns>(set, options.unknowns, problems)),
      noise_(options.noise) {
  if (noise_.empty()) noise_ = NoiseOf(set).levels;
  if (!problems->empty()) return;
  model_ = std::make_unique<RecordModel>(*unknowns_);
  model_->SetStop(options_.stop);
  for (const int e : options_.held_out) model_->LeaveOut(e);
}

bool FitProblem::IsHeldOut(std::size_t experiment) const {
  return model_->IsLeftOut(static_cast<int>(experiment));
}

void FitProblem::Refine(const FitPoint& at) {
  NoiseLevels levels = noise_;
  for (std::size_t e = 0; e < levels.size(); ++e)
    for (Eigen::Index c = 0; c < levels[e].size(); ++c)
      levels[e][c] *= std::max(1.0, RootMeanSquare(at.residuals[e].col(c)));
  model_->Refine(at.values, levels);
}

bool FitProblem::Sharpen(const FitPoint& at) {
  return at.cost < kMuchNoise * std::max(1.0, at.samples) &&
         SharpenWhereItMoves(at.jacobian, noise_, model_.get());
}

FitPoint FitProblem::PointOf(const FitResult& fit) {
  FitPoint point;
  if (!fit.ok) {
    point.interrupted = fit.interrupted;
    point.message = fit.message;
    return point;
  }
  if (fit.is_jacobian || fit.is_far) {
    RecordModel::Simulated found = model_->Simulate({fit.values}, model_->WholeHorizon()).front();
    if (found.ok) point = PointOf(fit.values, std::move(found.records), fit.jacobian);
  }
  if (!point.ok) point = PointAt(fit.values, fit.steps);
  point.interrupted = fit.interrupted;
  point.at_minimum = fit.at_minimum;
  point.iterations = fit.iterations;
  return point;
}

FitPoint FitProblem::At(const Eigen::VectorXd& values) { return PointAt(values, {}); }

FitPoint FitProblem::PointAt(const Eigen::VectorXd& values, Eigen::VectorXd steps) {
  const bool first = steps.size() == 0;
  if (first) steps = model_->SmallSteps();
  Linearised found = Linearise(*model_, values, model_->WholeHorizon(), noise_,
                               RecordModel::Difference::kForward, first, &steps);
  if (found.ok) return PointOf(values, std::move(found.simulated), std::move(found.jacobian));
  FitPoint none;
  none.message = found.message;
  return none;
}

FitPoint FitProblem::PointOf(const Eigen::VectorXd& values, Records simulated,
                             RecordJacobian jacobian) const {
  FitPoint point;
  point.ok = true;
  point.unknowns = unknowns_->all();
  point.values = values;
  point.simulated = std::move(simulated);
  point.noise = noise_;
  point.jacobian = std::move(jacobian);
  const auto& experiments = unknowns_->set().experiments;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    point.residuals.push_back(experiments[e].record.values - point.simulated[e]);
    const Eigen::MatrixXd weights = SampleWeights(*model_, e, noise_);
    if (IsHeldOut(e)) {
      for (Eigen::Index c = 0; c < weights.cols(); ++c) point.residuals[e].col(c) /= noise_[e][c];
      continue;
    }
    point.residuals[e].array() *= weights.array();
    point.cost += point.residuals[e].squaredNorm();
    point.samples += static_cast<double>((weights.array() > 0).count());
  }
  return point;
}

FitPoint FitProblem::FitFromAfar() {
  const FitResult start = cosserat_cable::FitFromAfar(model_.get(), {}, noise_, options_.progress);
  if (!start.ok || start.interrupted) {
    FitPoint none;
    none.interrupted = start.interrupted || model_->Stopping();
    none.message = start.message;
    return none;
  }
  FitPoint point = At(start.values);
  for (int round = 0; round < kRounds && point.ok && !point.interrupted; ++round) {
    Refine(point);
    const FitPoint next = FitFrom(point);
    if (!next.ok) {
      point.interrupted = next.interrupted;
      break;
    }
    point = next;
  }
  return point;
}

Eigen::VectorXd FitProblem::StartFrom(const FitPoint& start,
                                      const std::map<std::string, double>& also) const {
  Eigen::VectorXd values = unknowns_->StartValues();
  for (int i = 0; i < unknowns_->size(); ++i) {
    const Unknown& u = unknowns_->all()[static_cast<std::size_t>(i)];
    const double there = start.ValueOf(u.name);
    if (std::isfinite(there)) values[i] = there;
    if (const auto one = also.find(u.name); one != also.end()) values[i] = one->second;
    values[i] = std::clamp(values[i], u.lower, u.upper);
  }
  return values;
}

/// The start's derivatives, by the unknowns here.
RecordJacobian FitProblem::KnownFrom(const FitPoint& start) const {
  std::vector<RecordJacobian::Record> records;
  const auto& experiments = unknowns_->set().experiments;
  if (start.jacobian.records().size() != experiments.size() || start.noise != noise_) return {};
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const RecordJacobian::Record& from = start.jacobian.records()[e];
    if (from.columns.rows() != experiments[e].record.values.size()) return {};
    RecordJacobian::Record own;
    own.columns.resize(from.columns.rows(), 0);
    for (std::size_t k = 0; k < from.unknowns.size(); ++k) {
      const Unknown& there = start.unknowns[static_cast<std::size_t>(from.unknowns[k])];
      const int i = unknowns_->Find(there.name);
      if (i < 0 || unknowns_->all()[static_cast<std::size_t>(i)].scale != there.scale) continue;
      const Eigen::Index columns = own.columns.cols();
      own.columns.conservativeResize(Eigen::NoChange, columns + 1);
      own.columns.col(columns) = from.columns.col(static_cast<Eigen::Index>(k));
      if (IsHeldOut(e)) own.columns.col(columns).setZero();
      own.unknowns.push_back(i);
    }
    records.push_back(std::move(own));
  }
  return RecordJacobian(std::move(records), Eigen::VectorXd::Zero(unknowns_->size()));
}

FitResult FitProblem::WarmFit(const FitPoint& start, const std::map<std::string, double>& also,
                              bool finish) {
  FitOptions options;
  options.finish = finish;
  options.quick = options_.quick || !finish;
  // Derivatives are those of the start.
  const bool near = std::all_of(also.begin(), also.end(), [&](const auto& one) {
    const double there = start.ValueOf(one.first);
    return !std::isfinite(there) || std::abs(one.second - there) < kNear * std::abs(there);
  });
  if (near) options.known = KnownFrom(start);
  options.aim = 0.5 * options_.aim;
  const double samples = std::max(1.0, start.samples);
  options.to_noise = start.cost < kMuchNoise * samples;
  options.max_iterations = options_.max_iterations;
  for (const std::string& name : options_.held)
    if (const int i = unknowns_->Find(name); i >= 0) options.held.push_back(i);
  return Fit(*model_, StartFrom(start, also), model_->WholeHorizon(), noise_, options,
             options_.progress);
}

FitPoint FitProblem::FitFrom(const FitPoint& start, const std::map<std::string, double>& also) {
  return PointOf(WarmFit(start, also, true));
}

FitPoint FitProblem::ValuesFrom(const FitPoint& start) {
  const FitResult fit = WarmFit(start, {}, false);
  FitPoint point;
  point.ok = fit.ok;
  point.interrupted = fit.interrupted;
  point.unknowns = unknowns_->all();
  point.values = fit.values;
  return point;
}

Eigen::MatrixXd FitProblem::Predict(const FitPoint& at, int experiment) const {
  const auto e = static_cast<std::size_t>(experiment);
  const Experiment& of = unknowns_->set().experiments[e];
  MeasurementSet alone = unknowns_->set();
  alone.experiments = {of};
  Problems problems;
  FitProblemOptions options = options_;
  options.held_out.clear();
  options.noise = {noise_[e]};
  FitProblem problem(alone, options, &problems);
  if (!problems.empty()) return {};
  problem.model_->TakeStepsFrom(*model_, experiment);
  problem.unknowns_->ShareShapes(*unknowns_, experiment);
  Eigen::VectorXd values = problem.StartFrom(at, {});
  FitOptions fit;
  bool own = false;
  for (int i = 0; i < problem.unknowns_->size(); ++i) {
    if (problem.unknowns_->all()[static_cast<std::size_t>(i)].kind == Unknown::Kind::kCable)
      fit.held.push_back(i);
    else
      own = true;
  }
  Eigen::Index from = 0;
  if (own) {
    const std::optional<Horizon> periods = problem.model_->Beginning(kBeginningPeriods);
    const Horizon beginning = periods ? *periods : problem.model_->PartialHorizon(0.1, 2);
    const FitResult start =
        Fit(*problem.model_, values, beginning, problem.noise_, fit, options_.progress);
    if (!start.ok) return {};
    values = start.values;
    const std::vector<double>& t = of.record.t;
    from = std::upper_bound(t.begin(), t.end(), beginning[0]) - t.begin();
  }
  const RecordModel::Simulated found =
      problem.model_->Simulate({values}, problem.model_->WholeHorizon()).front();
  if (!found.ok) return {};
  Eigen::MatrixXd left = of.record.values - found.records[0];
  left.array() *= problem.model_->usable()[0].array();
  for (Eigen::Index c = 0; c < left.cols(); ++c) left.col(c) /= noise_[e][c];
  return left.bottomRows(left.rows() - from);
}

}  // namespace cosserat_cable
