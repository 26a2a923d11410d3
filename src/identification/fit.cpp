#include "fit.h"

#include <ceres/ceres.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "noise.h"

namespace cosserat_cable {
namespace {

constexpr int kMaxIterations = 40;
constexpr int kLooseIterations = 12;
constexpr double kLoose = 1e-3, kTight = 1e-8;  // last relative change of the cost
// No channel is taken to be better than this part of the widest range of its kind in its record:
// simulations are not.
constexpr double kBestChannel = 1e-7;
// Half of a sum of squares: what moves no parameter by a tenth of its standard deviation. One such
// step may be a step that was cut short, three in a row are the end.
constexpr double kSmallGain = 5e-3;
constexpr int kSmallGains = 3;
// Parts of the records that are fitted one after the other, and the fewest samples of a part.
constexpr double kParts[] = {0.06, 0.25, 1.0};
constexpr int kFewestSamples = 40;
// Of the slowest swing: in the first, the start is seen whatever the cable, in the second both.
constexpr double kStartPeriods[] = {0.3, 1.0};
// Of what is left over, what a parameter should explain at least when it moves by its whole size.
constexpr double kPower = 0.01;
const FitOptions kOnTheWay = {true, {}};
// Where the search looks: around the start, within these factors.
constexpr double kStiffnessSpread = 1.6, kDampingSpread = 6.0;
constexpr int kPoints = 24, kBest = 2;
// A derivative whose records, over the unknown's whole size, stay below this part of the noise's
// sum of squares is none.
constexpr double kUnseen = 1e-3;
// Steps with old derivatives; the gain in the sum of squares that is not worth another, and the
// loss that rounding may make.
constexpr int kPolishSteps = 6;
constexpr double kPolished = 1e-4, kPolishNoise = 1e-2;
constexpr std::uint32_t kSeed = 20150113;

/// All records against one block of unknowns in units of their scales.
class RecordCost : public ceres::CostFunction {
 public:
  /// `jacobian`: where the last one is left.
  RecordCost(const RecordModel& model, const Horizon& horizon, const NoiseLevels& noise, int count,
             Eigen::MatrixXd* jacobian)
      : model_(model), horizon_(horizon), noise_(noise), jacobian_(jacobian) {
    mutable_parameter_block_sizes()->push_back(model.unknowns().size());
    set_num_residuals(count);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const int n = model_.unknowns().size();
    Eigen::VectorXd values(n);
    for (int i = 0; i < n; ++i) values[i] = parameters[0][i] * model_.unknowns().all()[i].scale;
    Eigen::Map<Eigen::VectorXd> out(residuals, num_residuals());
    if (jacobians && jacobians[0]) {
      const RecordModel::Derivatives found =
          model_.Differentiate(values, horizon_, RecordModel::Difference::kForward);
      if (!found.at.ok) return false;
      out = WeightedResiduals(model_, values, found.at.records, noise_);
      const Eigen::MatrixXd jacobian = WeightedJacobian(model_, found, noise_);
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          jacobians[0], num_residuals(), n) = jacobian;
      *jacobian_ = jacobian;
      return true;
    }
    const RecordModel::Simulated found = model_.Simulate({values}, horizon_).front();
    if (!found.ok) return false;
    out = WeightedResiduals(model_, values, found.records, noise_);
    return true;
  }

 private:
  const RecordModel& model_;
  const Horizon& horizon_;
  const NoiseLevels& noise_;
  Eigen::MatrixXd* jacobian_;
};

/// Ends a fit where the cost falls no more by what counts beside the noise.
class Callback : public ceres::IterationCallback {
 public:
  explicit Callback(const FitProgress& progress) : progress_(progress) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (progress_ && !progress_("iteration " + std::to_string(summary.iteration)))
      return ceres::SOLVER_ABORT;
    const bool small = summary.iteration > 0 && summary.cost_change < kSmallGain;
    small_gains_ = small ? small_gains_ + 1 : 0;
    return small_gains_ >= kSmallGains ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                       : ceres::SOLVER_CONTINUE;
  }

 private:
  const FitProgress& progress_;
  int small_gains_ = 0;
};

int SamplesUntil(const Experiment& experiment, double time) {
  const std::vector<double>& t = experiment.record.t;
  return static_cast<int>(std::upper_bound(t.begin(), t.end(), time) - t.begin());
}

void LeaveOutUnseen(const Eigen::VectorXd& values, const NoiseLevels& noise, RecordModel* model) {
  const RecordModel::Derivatives found =
      model->Differentiate(values, model->WholeHorizon(), RecordModel::Difference::kForward);
  if (!found.at.ok) return;
  for (std::size_t i = 0; i < found.by_unknown.size(); ++i)
    for (std::size_t e = 0; e < noise.size(); ++e) {
      const Eigen::MatrixXd& by = found.by_unknown[i][e];
      double seen = 0;
      for (int c = 0; c < by.cols(); ++c)
        seen += by.col(c).squaredNorm() / std::pow(noise[e][c], 2);
      if (by.size() > 0 && seen < kUnseen) model->Ignore(static_cast<int>(i), static_cast<int>(e));
    }
}

/// Spread evenly over the box around the start, the same on each run.
std::vector<Eigen::VectorXd> PointsAround(const Unknowns& unknowns) {
  std::mt19937 random(kSeed);
  // A Latin hypercube: every unknown takes each of its levels once.
  std::vector<std::vector<int>> levels(unknowns.size());
  for (auto& order : levels) {
    order.resize(kPoints);
    for (int k = 0; k < kPoints; ++k) order[k] = k;
    for (int k = kPoints - 1; k > 0; --k)
      std::swap(order[k], order[random() % static_cast<std::uint32_t>(k + 1)]);
  }
  std::vector<Eigen::VectorXd> points;
  for (int k = 0; k < kPoints; ++k) {
    Eigen::VectorXd values = unknowns.StartValues();
    for (int i = 0; i < unknowns.size(); ++i) {
      const Unknown& u = unknowns.all()[i];
      if (u.kind != Unknown::Kind::kCable) continue;
      const double level = 2 * (levels[i][k] + 0.5) / kPoints - 1;  // in (-1, 1)
      const double spread = u.damping && !u.start_known ? kDampingSpread : kStiffnessSpread;
      values[i] = std::clamp((values[i] > 0 ? values[i] : u.scale) * std::pow(spread, level),
                             u.lower, u.upper);
    }
    points.push_back(values);
  }
  return points;
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

Eigen::MatrixXd WeightedJacobian(const RecordModel& model,
                                 const RecordModel::Derivatives& derivatives,
                                 const NoiseLevels& noise) {
  const Records& records = derivatives.at.records;
  const int unknowns = model.unknowns().size();
  int rows = 0, priors = 0;
  for (const Eigen::MatrixXd& record : records) rows += static_cast<int>(record.size());
  for (const Unknown& u : model.unknowns().all()) priors += u.prior_sd > 0;
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows + priors, unknowns);
  std::vector<Eigen::MatrixXd> weights;
  for (std::size_t e = 0; e < records.size(); ++e)
    weights.push_back(SampleWeights(model, e, noise));
  int prior = rows;
  for (int i = 0; i < unknowns; ++i) {
    int row = 0;
    for (std::size_t e = 0; e < records.size(); ++e) {
      const Eigen::MatrixXd& by = derivatives.by_unknown[i][e];
      for (int c = 0; c < records[e].cols(); ++c) {
        const int n = static_cast<int>(records[e].rows());
        if (by.size() > 0)
          jacobian.col(i).segment(row, n) = -by.col(c).cwiseProduct(weights[e].col(c).head(n));
        row += n;
      }
    }
    const Unknown& u = model.unknowns().all()[i];
    if (u.prior_sd > 0) jacobian(prior++, i) = -u.scale / u.prior_sd;
  }
  return jacobian;
}

FitResult Fit(const RecordModel& model, const Eigen::VectorXd& values, const Horizon& horizon,
              const NoiseLevels& noise, const FitOptions& fit, const FitProgress& progress) {
  const Unknowns& unknowns = model.unknowns();
  int count = 0;
  for (std::size_t e = 0; e < horizon.size(); ++e) {
    const Experiment& experiment = unknowns.set().experiments[e];
    count += SamplesUntil(experiment, horizon[e]) * static_cast<int>(experiment.channels.size());
  }
  for (const Unknown& u : unknowns.all()) count += u.prior_sd > 0;

  Eigen::VectorXd x(unknowns.size());
  for (int i = 0; i < unknowns.size(); ++i) x[i] = values[i] / unknowns.all()[i].scale;
  FitResult result;
  ceres::Problem problem;
  problem.AddResidualBlock(new RecordCost(model, horizon, noise, count, &result.jacobian), nullptr,
                           x.data());
  for (int i = 0; i < unknowns.size(); ++i) {
    const Unknown& u = unknowns.all()[i];
    if (std::isfinite(u.lower)) problem.SetParameterLowerBound(x.data(), i, u.lower / u.scale);
    if (std::isfinite(u.upper)) problem.SetParameterUpperBound(x.data(), i, u.upper / u.scale);
  }
  if (!fit.held.empty())
    problem.SetManifold(x.data(), new ceres::SubsetManifold(unknowns.size(), fit.held));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = fit.loose ? kLooseIterations : kMaxIterations;
  options.function_tolerance = fit.loose ? kLoose : kTight;
  options.parameter_tolerance = fit.loose ? 1e-4 : 1e-7;
  options.logging_type = ceres::SILENT;
  Callback callback(progress);
  options.callbacks.push_back(&callback);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  result.interrupted = summary.termination_type == ceres::USER_FAILURE;
  result.ok = summary.IsSolutionUsable() && !result.interrupted;
  result.message = summary.message;
  result.cost = summary.final_cost;
  result.iterations = static_cast<int>(summary.iterations.size());
  result.values.resize(unknowns.size());
  for (int i = 0; i < unknowns.size(); ++i) result.values[i] = x[i] * unknowns.all()[i].scale;
  return result;
}

bool Polish(const RecordModel& model, const Eigen::MatrixXd& jacobian, const NoiseLevels& noise,
            Eigen::VectorXd* values) {
  const Unknowns& unknowns = model.unknowns();
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solve(jacobian);
  Eigen::VectorXd best = *values;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step <= kPolishSteps; ++step) {
    const RecordModel::Simulated found = model.Simulate({best}, model.WholeHorizon()).front();
    if (!found.ok) return false;
    const Eigen::VectorXd residuals = WeightedResiduals(model, best, found.records, noise);
    const double cost = residuals.squaredNorm();
    if (cost > least + kPolishNoise) return false;
    least = std::min(least, cost);
    *values = best;
    const Eigen::VectorXd move = -solve.solve(residuals);
    const double gain = (jacobian * move).squaredNorm();
    if (gain < kPolished) return true;
    for (int i = 0; i < unknowns.size(); ++i) {
      const Unknown& u = unknowns.all()[i];
      best[i] = std::clamp(best[i] + move[i] * u.scale, u.lower, u.upper);
    }
  }
  return false;
}

/// The cable's parameters that explain little of what is left over, however far they are moved:
/// while much is, they would only be led astray.
std::vector<int> Powerless(const RecordModel& model, const Eigen::VectorXd& values,
                           const Horizon& horizon, const NoiseLevels& noise) {
  std::vector<int> powerless;
  const RecordModel::Derivatives found =
      model.Differentiate(values, horizon, RecordModel::Difference::kForward);
  if (!found.at.ok) return powerless;
  const Eigen::MatrixXd jacobian = WeightedJacobian(model, found, noise);
  const double left = WeightedResiduals(model, values, found.at.records, noise).squaredNorm();
  for (int i = 0; i < model.unknowns().size(); ++i)
    if (model.unknowns().all()[i].kind == Unknown::Kind::kCable &&
        jacobian.col(i).squaredNorm() < kPower * left)
      powerless.push_back(i);
  return powerless;
}

/// From a point, to the first part of the records.
FitResult FitFirst(const RecordModel& model, Eigen::VectorXd values, const Horizon& horizon,
                   const NoiseLevels& noise, const FitProgress& progress) {
  FitOptions options = kOnTheWay;
  for (const double periods : kStartPeriods) {
    const std::optional<Horizon> beginning = model.Beginning(periods);
    if (!beginning) return Fit(model, values, horizon, noise, options, progress);
    if (periods == kStartPeriods[0]) {
      for (int i = 0; i < model.unknowns().size(); ++i)
        if (model.unknowns().all()[i].kind == Unknown::Kind::kCable) options.held.push_back(i);
    } else {
      options.held = Powerless(model, values, *beginning, noise);
    }
    const FitResult fit = Fit(model, values, *beginning, noise, options, progress);
    if (fit.interrupted) return fit;
    if (fit.ok) values = fit.values;
  }
  options.held = Powerless(model, values, horizon, noise);
  return Fit(model, values, horizon, noise, options, progress);
}

FitResult FitFromAfar(RecordModel* model, const std::vector<Eigen::VectorXd>& more,
                      const NoiseLevels& noise, const FitProgress& progress) {
  std::vector<Eigen::VectorXd> points = more;
  points.push_back(model->unknowns().StartValues());
  // Where a start is unknown, all points look alike before it is fitted.
  const auto& experiments = model->unknowns().set().experiments;
  const bool comparable =
      std::none_of(experiments.begin(), experiments.end(), [](const Experiment& experiment) {
        return experiment.start.kind == StartCondition::Kind::kUnknown;
      });
  if (comparable) {
    const std::vector<Eigen::VectorXd> around = PointsAround(model->unknowns());
    points.insert(points.end(), around.begin(), around.end());
  }
  const Horizon first = model->PartialHorizon(kParts[0], kFewestSamples);
  if (progress && !progress("looking for a start")) {
    FitResult stopped;
    stopped.interrupted = true;
    return stopped;
  }
  const std::vector<RecordModel::Simulated> all = model->Simulate(points, first);
  std::vector<std::pair<double, std::size_t>> ranking;
  std::string why;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!all[p].ok) {
      why = all[p].message;
      continue;
    }
    const double cost = WeightedResiduals(*model, points[p], all[p].records, noise).squaredNorm();
    if (std::isfinite(cost)) ranking.push_back({cost, p});
  }
  FitResult best;
  best.message = why;
  if (ranking.empty()) return best;
  std::sort(ranking.begin(), ranking.end());
  for (std::size_t k = 0; k < std::min<std::size_t>(kBest, ranking.size()); ++k) {
    const FitResult fit = FitFirst(*model, points[ranking[k].second], first, noise, progress);
    if (fit.interrupted) return fit;
    if (fit.ok && (!best.ok || fit.cost < best.cost)) best = fit;
  }
  for (std::size_t part = 1; part < std::size(kParts) && best.ok; ++part) {
    const bool last = part + 1 == std::size(kParts);
    const Horizon horizon =
        last ? model->WholeHorizon() : model->PartialHorizon(kParts[part], kFewestSamples);
    if (last) LeaveOutUnseen(best.values, noise, model);
    FitOptions options = kOnTheWay;
    if (!comparable) options.held = Powerless(*model, best.values, horizon, noise);
    best = Fit(*model, best.values, horizon, noise, options, progress);
    if (best.interrupted) return best;
  }
  return best;
}

}  // namespace cosserat_cable
