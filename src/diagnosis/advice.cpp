#include "advice.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// Standard deviations that tell two models apart beyond doubt; fewer are no advice.
constexpr double kTells = 6;
constexpr double kRidge = 1e-9;

/// What a model makes of a design, with its derivatives.
FitPoint Simulate(const FittedTrial& model, const Design& design, const NoiseLevels& noise) {
  MeasurementSet alone = model.set;
  alone.experiments = {design.experiment};
  FitProblemOptions options;
  options.unknowns.end_damping = false;
  const Eigen::VectorXd& levels = noise[static_cast<std::size_t>(design.like)];
  const auto channels = static_cast<Eigen::Index>(design.experiment.channels.size());
  options.noise = {channels == levels.size() ? levels
                                             : Eigen::VectorXd::Constant(channels, levels.mean())};
  Problems problems;
  FitProblem problem(alone, options, &problems);
  if (!problems.empty()) return {};
  FitPoint point = problem.At(problem.StartFrom(model.point, {}));
  if (!point.ok) return point;
  for (Eigen::Index c = 0; c < channels; ++c) point.simulated[0].col(c) /= options.noise[0][c];
  return point;
}

/// How far the rival stays from the best in the design, in standard deviations, when it is refitted
/// to that and to all that it was fitted to before.
double Separation(const FitPoint& best, const FitPoint& there, const FitPoint& rival) {
  const Eigen::MatrixXd difference = best.simulated[0] - there.simulated[0];
  const Eigen::Map<const Eigen::VectorXd> d(difference.data(), difference.size());
  const RecordJacobian::Record& record = there.jacobian.records()[0];
  Eigen::MatrixXd gram = rival.jacobian.Gram();
  Eigen::VectorXd towards = Eigen::VectorXd::Zero(gram.rows());
  std::vector<int> where;
  for (const int u : record.unknowns) {
    const std::string& name = there.unknowns[static_cast<std::size_t>(u)].name;
    int found = -1;
    for (std::size_t i = 0; i < rival.unknowns.size(); ++i)
      if (rival.unknowns[i].name == name) found = static_cast<int>(i);
    where.push_back(found);
  }
  for (std::size_t i = 0; i < where.size(); ++i) {
    if (where[i] < 0) continue;
    const auto column = record.columns.col(static_cast<Eigen::Index>(i));
    towards[where[i]] += column.dot(d);
    for (std::size_t k = 0; k < where.size(); ++k)
      if (where[k] >= 0)
        gram(where[i], where[k]) += column.dot(record.columns.col(static_cast<Eigen::Index>(k)));
  }
  const Eigen::VectorXd unit =
      gram.diagonal().unaryExpr([](double x) { return x > 0 ? 1 / std::sqrt(x) : 0.0; });
  Eigen::MatrixXd scaled = unit.asDiagonal() * gram * unit.asDiagonal();
  scaled.diagonal().array() += kRidge;
  const Eigen::VectorXd b = unit.cwiseProduct(towards);
  return std::sqrt(std::max(0.0, d.squaredNorm() - b.dot(scaled.llt().solve(b))));
}

}  // namespace

std::string NextExperiment(const MeasurementSet& set, const NoiseLevels& noise,
                           const MotionScales& scales, const FittedTrial& best,
                           const std::vector<const FittedTrial*>& rivals,
                           const std::function<bool()>& stop) {
  double most = 0;
  std::string text;
  for (const Design& design : DesignMenu(set, scales)) {
    if (stop()) break;
    const FitPoint of_best = Simulate(best, design, noise);
    if (!of_best.ok) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const FittedTrial* rival : rivals) {
      const FitPoint there = Simulate(*rival, design, noise);
      if (!there.ok || there.simulated[0].rows() != of_best.simulated[0].rows())
        least = 0;
      else
        least = std::min(least, Separation(of_best, there, rival->point));
    }
    if (!std::isfinite(least) || least <= most) continue;
    most = least;
    text = design.text;
  }
  if (most < kTells) return "";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ": the models would differ there by " + FormatRounded(most, 2) +
         " standard deviations of the noise after each has been fitted again.";
}

}  // namespace cosserat_cable
