#include "held_out.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

namespace cosserat_cable {
namespace {

// A parameter stays where all records put it where the others know it so many times worse.
constexpr double kWorse = 10;
constexpr double kRidge = 1e-12;
// Of a single record: what is fitted; the rest is predicted.
constexpr double kFittedPart = 0.6;
constexpr Eigen::Index kBlocks = 8;  // of a record, for the bootstrap
constexpr int kResamples = 1000;
constexpr std::uint32_t kSeed = 20150113;
// The mean square, in the noise's variance, below which a baseline leaves nothing to gain.
constexpr double kNothingLeft = 1.02;

/// Inverse of a symmetric positive matrix whose unknowns have any scales.
Eigen::MatrixXd Inverse(const Eigen::MatrixXd& gram) {
  const Eigen::VectorXd unit =
      gram.diagonal().unaryExpr([](double x) { return x > 0 ? 1 / std::sqrt(x) : 0.0; });
  Eigen::MatrixXd scaled = unit.asDiagonal() * gram * unit.asDiagonal();
  scaled.diagonal().array() += kRidge;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(gram.rows(), gram.cols());
  return unit.asDiagonal() * scaled.llt().solve(identity) * unit.asDiagonal();
}

bool IsCommon(const FitPoint& point, int unknown) {
  return point.unknowns[static_cast<std::size_t>(unknown)].experiment < 0;
}

/// What the records without one say, by J^T J; what is that one's alone keeps what it says of it.
Eigen::MatrixXd GramWithout(const FitPoint& point, std::size_t e) {
  Eigen::MatrixXd gram = point.jacobian.Gram();
  const RecordJacobian::Record& record = point.jacobian.records()[e];
  const Eigen::MatrixXd own = record.columns.transpose() * record.columns;
  for (std::size_t k = 0; k < record.unknowns.size(); ++k)
    for (std::size_t l = 0; l < record.unknowns.size(); ++l)
      if (IsCommon(point, record.unknowns[k]) && IsCommon(point, record.unknowns[l]))
        gram(record.unknowns[k], record.unknowns[l]) -=
            own(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l));
  return gram;
}

/// By unknown, whether the records without one know it hardly.
std::vector<bool> HardlyKnown(const FitPoint& point, const Eigen::MatrixXd& gram) {
  const Eigen::VectorXd all = Inverse(point.jacobian.Gram()).diagonal();
  const Eigen::VectorXd others = Inverse(gram).diagonal();
  std::vector<bool> hardly;
  for (Eigen::Index i = 0; i < all.size(); ++i)
    hardly.push_back(IsCommon(point, static_cast<int>(i)) &&
                     !(others[i] > 0 && others[i] < kWorse * kWorse * all[i]));
  return hardly;
}

struct Block {
  double baseline = 0, extended = 0, samples = 0;
};

double Gain(const std::vector<Block>& blocks) {
  Block all;
  for (const Block& block : blocks) {
    all.baseline += block.baseline;
    all.extended += block.extended;
    all.samples += block.samples;
  }
  return (all.baseline - all.extended) / std::max(all.baseline - all.samples, 1e-300);
}

/// The last part of a single record, predicted from its first.
Records OfLastPart(const FittedModel& model, FitProblemOptions options) {
  MeasurementSet first = model.set;
  Record& record = first.experiments[0].record;
  const auto rows = static_cast<Eigen::Index>(record.t.size());
  const auto kept = static_cast<Eigen::Index>(kFittedPart * static_cast<double>(rows));
  if (kept < 3) return {Eigen::MatrixXd()};
  record.t.resize(static_cast<std::size_t>(kept));
  record.values = Eigen::MatrixXd(record.values.topRows(kept));
  Problems problems;
  FitProblem fit(first, options, &problems);
  FitProblem whole(model.set, options, &problems);
  if (!problems.empty()) return {Eigen::MatrixXd()};
  fit.ShareSteps(model.problem);
  const FitPoint found = fit.FitFrom(model.point);
  if (!found.ok) return {Eigen::MatrixXd()};
  whole.ShareSteps(model.problem);
  const FitPoint there = whole.At(whole.StartFrom(found, {}));
  if (!there.ok) return {Eigen::MatrixXd()};
  return {there.residuals[0].bottomRows(rows - kept)};
}

}  // namespace

Records LinearisedHeldOut(const FitPoint& point) {
  Records predicted;
  for (std::size_t e = 0; e < point.residuals.size(); ++e) {
    const RecordJacobian::Record& record = point.jacobian.records()[e];
    const Eigen::Map<const Eigen::VectorXd> left(point.residuals[e].data(),
                                                 point.residuals[e].size());
    Eigen::MatrixXd gram = GramWithout(point, e);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(gram.rows());
    const Eigen::VectorXd towards = record.columns.transpose() * left;
    for (std::size_t k = 0; k < record.unknowns.size(); ++k)
      if (IsCommon(point, record.unknowns[k]))
        gradient[record.unknowns[k]] = towards[static_cast<Eigen::Index>(k)];
    const std::vector<bool> hardly = HardlyKnown(point, gram);
    for (std::size_t i = 0; i < hardly.size(); ++i) {
      if (!hardly[i]) continue;
      const auto k = static_cast<Eigen::Index>(i);
      gram.row(k).setZero();
      gram.col(k).setZero();
      gram(k, k) = 1;
      gradient[k] = 0;
    }
    const Eigen::VectorXd step = Inverse(gram) * gradient;
    Eigen::VectorXd moved = left;
    for (std::size_t k = 0; k < record.unknowns.size(); ++k)
      moved += step[record.unknowns[k]] * record.columns.col(static_cast<Eigen::Index>(k));
    predicted.push_back(Eigen::Map<const Eigen::MatrixXd>(moved.data(), point.residuals[e].rows(),
                                                          point.residuals[e].cols()));
  }
  return predicted;
}

Records ExactHeldOut(const FittedModel& model, const FitProblemOptions& options) {
  const auto count = static_cast<int>(model.set.experiments.size());
  if (count == 1) return OfLastPart(model, options);
  Records predicted;
  for (int e = 0; e < count; ++e) {
    FitProblemOptions without = options;
    without.held_out = {e};
    const std::vector<bool> hardly =
        HardlyKnown(model.point, GramWithout(model.point, static_cast<std::size_t>(e)));
    for (std::size_t i = 0; i < hardly.size(); ++i)
      if (hardly[i]) without.held.push_back(model.point.unknowns[i].name);
    Problems problems;
    FitProblem problem(model.set, without, &problems);
    predicted.emplace_back();
    if (!problems.empty()) continue;
    problem.ShareSteps(model.problem);
    const FitPoint found = problem.ValuesFrom(model.point);
    if (found.ok) predicted.back() = problem.Predict(found, e);
  }
  return predicted;
}

Records PredictOthers(const MeasurementSet& set, const std::vector<int>& fitted,
                      const FitPoint& point, const FitProblemOptions& options) {
  Problems problems;
  const FitProblem problem(set, options, &problems);
  Records predicted;
  for (int e = 0; e < static_cast<int>(set.experiments.size()); ++e) {
    if (std::count(fitted.begin(), fitted.end(), e) > 0) continue;
    predicted.emplace_back();
    if (problems.empty() && !(options.stop && options.stop()))
      predicted.back() = problem.Predict(point, e);
  }
  return predicted;
}

std::optional<GainEstimate> GainOf(const Records& baseline, const Records& extended) {
  std::vector<Block> blocks;
  Block all;
  for (std::size_t e = 0; e < baseline.size(); ++e) {
    const Eigen::Index rows = baseline[e].rows(), count = std::min(kBlocks, rows);
    if (rows == 0 || extended[e].rows() != rows) continue;
    for (Eigen::Index b = 0; b < count; ++b) {
      const Eigen::Index from = b * rows / count, size = (b + 1) * rows / count - from;
      Block block;
      block.baseline = baseline[e].middleRows(from, size).squaredNorm();
      block.extended = extended[e].middleRows(from, size).squaredNorm();
      block.samples = static_cast<double>(size * baseline[e].cols());
      blocks.push_back(block);
      all.baseline += block.baseline;
      all.extended += block.extended;
      all.samples += block.samples;
    }
  }
  if (blocks.empty() || all.baseline < kNothingLeft * all.samples) return std::nullopt;
  GainEstimate gain;
  gain.value = Gain(blocks);
  gain.rms_baseline = std::sqrt(all.baseline / all.samples);
  gain.rms_extended = std::sqrt(all.extended / all.samples);
  std::mt19937 random(kSeed);
  std::vector<double> gains;
  for (int k = 0; k < kResamples; ++k) {
    std::vector<Block> sample;
    for (std::size_t b = 0; b < blocks.size(); ++b)
      sample.push_back(blocks[random() % static_cast<std::uint32_t>(blocks.size())]);
    gains.push_back(Gain(sample));
  }
  std::sort(gains.begin(), gains.end());
  gain.low = std::min(gain.value, gains[static_cast<std::size_t>(0.025 * kResamples)]);
  gain.high = std::max(gain.value, gains[static_cast<std::size_t>(0.975 * kResamples)]);
  return gain;
}

}  // namespace cosserat_cable
