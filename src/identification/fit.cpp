#include "fit.h"

#include <ceres/ceres.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "noise.h"

namespace cosserat_cable {
namespace {

constexpr int kMaxIterations = 40;
constexpr int kLooseIterations = 12;
constexpr double kLoose = 1e-3, kTight = 1e-8;  // last relative change of the cost
// Parts of the records that are fitted one after the other, and the fewest samples of a part.
constexpr double kParts[] = {0.06, 0.25, 1.0};
constexpr int kFewestSamples = 40;
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

class Callback : public ceres::IterationCallback {
 public:
  explicit Callback(const FitProgress& progress) : progress_(progress) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (!progress_) return ceres::SOLVER_CONTINUE;
    return progress_("iteration " + std::to_string(summary.iteration)) ? ceres::SOLVER_CONTINUE
                                                                       : ceres::SOLVER_ABORT;
  }

 private:
  const FitProgress& progress_;
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

NoiseLevels GuessNoise(const RecordModel& model) {
  NoiseLevels noise;
  for (const Experiment& experiment : model.unknowns().set().experiments) {
    const Eigen::MatrixXd& values = experiment.record.values;
    const Eigen::MatrixXd& usable = model.usable()[noise.size()];
    Eigen::VectorXd levels(values.cols());
    for (Eigen::Index c = 0; c < values.cols(); ++c) {
      const double range = values.col(c).maxCoeff() - values.col(c).minCoeff();
      const double floor =
          std::max(kBestChannel * range, std::numeric_limits<double>::min() * 1e10);
      const auto& sigma = experiment.channels[static_cast<std::size_t>(c)].sigma;
      levels[c] = std::max(sigma ? *sigma : NoiseOfSmooth(values.col(c), usable.col(c)), floor);
    }
    noise.push_back(levels);
  }
  return noise;
}

Eigen::VectorXd WeightedResiduals(const RecordModel& model, const Eigen::VectorXd& values,
                                  const Records& simulated, const NoiseLevels& noise) {
  const auto& experiments = model.unknowns().set().experiments;
  std::vector<double> residuals;
  for (std::size_t e = 0; e < experiments.size(); ++e)
    for (int c = 0; c < simulated[e].cols(); ++c)
      for (int i = 0; i < simulated[e].rows(); ++i)
        residuals.push_back(model.usable()[e](i, c) *
                            (experiments[e].record.values(i, c) - simulated[e](i, c)) /
                            noise[e][c]);
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
  int prior = rows;
  for (int i = 0; i < unknowns; ++i) {
    int row = 0;
    for (std::size_t e = 0; e < records.size(); ++e) {
      const Eigen::MatrixXd& by = derivatives.by_unknown[i][e];
      for (int c = 0; c < records[e].cols(); ++c) {
        const int n = static_cast<int>(records[e].rows());
        if (by.size() > 0)
          jacobian.col(i).segment(row, n) =
              -by.col(c).cwiseProduct(model.usable()[e].col(c).head(n)) / noise[e][c];
        row += n;
      }
    }
    const Unknown& u = model.unknowns().all()[i];
    if (u.prior_sd > 0) jacobian(prior++, i) = -u.scale / u.prior_sd;
  }
  return jacobian;
}

FitResult Fit(const RecordModel& model, const Eigen::VectorXd& values, const Horizon& horizon,
              const NoiseLevels& noise, bool loose, const FitProgress& progress) {
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
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = loose ? kLooseIterations : kMaxIterations;
  options.function_tolerance = loose ? kLoose : kTight;
  options.parameter_tolerance = loose ? 1e-4 : 1e-7;
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

FitResult FitFromAfar(RecordModel* model, const std::vector<Eigen::VectorXd>& more,
                      const NoiseLevels& noise, const FitProgress& progress) {
  std::vector<Eigen::VectorXd> points = PointsAround(model->unknowns());
  points.push_back(model->unknowns().StartValues());
  points.insert(points.end(), more.begin(), more.end());
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
    FitResult fit = Fit(*model, points[ranking[k].second], first, noise, true, progress);
    if (fit.interrupted) return fit;
    if (fit.ok && (!best.ok || fit.cost < best.cost)) best = fit;
  }
  for (std::size_t part = 1; part < std::size(kParts) && best.ok; ++part) {
    const bool last = part + 1 == std::size(kParts);
    const Horizon horizon =
        last ? model->WholeHorizon() : model->PartialHorizon(kParts[part], kFewestSamples);
    if (last) LeaveOutUnseen(best.values, noise, model);
    best = Fit(*model, best.values, horizon, noise, true, progress);
    if (best.interrupted) return best;
  }
  return best;
}

}  // namespace cosserat_cable
