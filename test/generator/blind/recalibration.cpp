#include "recalibration.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "../noise.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector4d;
using Eigen::VectorXd;

CableData changed(CableData cable, const Vector4d& change) {
  cable.EI *= std::exp(change[0]);
  cable.eta_EI *= std::exp(change[1]);
  cable.GJ *= std::exp(change[2]);
  cable.eta_GJ *= std::exp(change[3]);
  return cable;
}

/// Whether a record shows enough of a parameter to be worth a simulation.
bool shows(const Experiment& e, int parameter) {
  if (!e.tip_forces.empty()) return parameter == 0;
  if (e.disc) return parameter >= 2;
  return parameter < 2 || e.b.has_value();
}

VectorXd flat(const Eigen::MatrixXd& values, const VectorXd& sigma) {
  const Eigen::MatrixXd weighted = values * sigma.cwiseInverse().asDiagonal();
  return Eigen::Map<const VectorXd>(weighted.data(), weighted.size());
}

}  // namespace

Accuracy searchAccuracy() { return {{6, 4, 10}, 1e-5}; }
Accuracy recordAccuracy(const Experiment& e) {
  // The curvature of an arch varies more along the cable than that of one with a free end.
  return {e.b ? Resolution{12, 9, 20} : Resolution{8, 5, 14}, 1e-6};
}

std::vector<Experiment> plain(std::vector<Experiment> experiments) {
  for (Experiment& e : experiments) e.effects.clear();
  return experiments;
}

std::vector<VectorXd> noiseOf(const std::vector<Experiment>& experiments,
                              const std::vector<Record>& records, double snr) {
  constexpr double kStill = 0.01;  // lengths
  std::vector<VectorXd> sigma;
  for (size_t i = 0; i < experiments.size(); ++i) {
    const auto& channels = experiments[i].channels;
    const int count = static_cast<int>(channels.size());
    VectorXd own(count);
    double sum = 0.0;
    int positions = 0;
    for (int c = 0; c < count; ++c) {
      own[c] = noiseSigma(records[i].values.col(c), records[i].rest[c], snr);
      if (channels[c].quantity != Channel::Quantity::kPosition) continue;
      sum += own[c] * own[c];
      ++positions;
    }
    // Where a disc hangs still or no force pulls, a camera has noise all the same.
    const bool may_rest = experiments[i].disc || !experiments[i].tip_forces.empty();
    const double still = may_rest ? kStill * experiments[i].cable.length : 0.0;
    const double least = still * std::pow(10.0, -snr / 20.0);
    for (int c = 0; c < count; ++c) {
      if (channels[c].quantity == Channel::Quantity::kPosition) {
        own[c] = std::max(least, std::sqrt(sum / positions));
      }
    }
    sigma.push_back(own);
  }
  return sigma;
}

Recalibration::Recalibration(const std::vector<Experiment>& experiments, double snr) {
  constexpr double kSteps[] = {1e-3, 1e-2, 1e-3, 1e-2};
  std::vector<Record> records;
  for (const Experiment& e : plain(experiments)) records.push_back(simulate(e, searchAccuracy()));
  sigma_ = noiseOf(experiments, records, snr);
  Eigen::Index rows = 0;
  for (const Record& record : records) rows += record.values.size();
  derivatives_.setZero(rows, 4);
  Eigen::Index first = 0;
  for (size_t i = 0; i < experiments.size(); ++i) {
    const VectorXd before = flat(records[i].values, sigma_[i]);
    for (int p = 0; p < 4; ++p) {
      if (!shows(experiments[i], p)) continue;
      Experiment e = plain({experiments[i]}).front();
      e.cable = changed(e.cable, kSteps[p] * Vector4d::Unit(p));
      const VectorXd after = flat(simulate(e, searchAccuracy()).values, sigma_[i]);
      derivatives_.block(first, p, before.size(), 1) = (after - before) / kSteps[p];
    }
    first += before.size();
  }
}

VectorXd Recalibration::weighted(const std::vector<Experiment>& experiments,
                                 const Vector4d& change) const {
  VectorXd result(derivatives_.rows());
  Eigen::Index first = 0;
  for (size_t i = 0; i < experiments.size(); ++i) {
    Experiment e = experiments[i];
    e.cable = changed(e.cable, change);
    const VectorXd part = flat(simulate(e, searchAccuracy()).values, sigma_[i]);
    result.segment(first, part.size()) = part;
    first += part.size();
  }
  return result;
}

Recalibration::Answer Recalibration::fit(const std::vector<Experiment>& experiments,
                                         const Vector4d& guess) const {
  constexpr int kIterations = 3;
  constexpr double kLongest = 0.5;  // of a logarithm's change
  constexpr double kEnough = 0.05;  // gained of the rms
  constexpr double kLinear = 0.8;  // of the rms: a last step takes so little that it needs no trial
  const VectorXd shown = weighted(experiments, Vector4d::Zero());
  const std::vector<Experiment> rods = plain(experiments);
  const auto decomposition = derivatives_.colPivHouseholderQr();
  Answer answer;
  answer.strength = 1e300;
  Vector4d change = guess;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const VectorXd residual = shown - weighted(rods, change);
    const double rms = residual.norm() / std::sqrt(static_cast<double>(residual.size()));
    if (rms >= answer.strength) break;
    const bool first = iteration == 0;
    const double before = answer.strength;
    answer.strength = rms;
    answer.change = change;
    answer.residual = residual;
    if (!first && rms > (1.0 - kEnough) * before) break;
    Vector4d step = decomposition.solve(residual);
    if ((residual - derivatives_ * step).norm() > kLinear * residual.norm()) break;
    if (step.norm() > kLongest) step *= kLongest / step.norm();
    change += step;
  }
  // What a last step without simulation would take.
  const Vector4d step = decomposition.solve(answer.residual);
  const VectorXd left = answer.residual - derivatives_ * step;
  if (left.norm() < answer.residual.norm()) {
    answer.residual = left;
    answer.change += step;
  }
  answer.strength = answer.residual.norm() / std::sqrt(static_cast<double>(left.size()));
  Eigen::Index at = 0;
  for (const Experiment& e : experiments) {
    const auto count = e.times.size() * static_cast<Eigen::Index>(e.channels.size());
    answer.experiments.push_back(answer.residual.segment(at, count).norm() /
                                 std::sqrt(static_cast<double>(count)));
    at += count;
  }
  return answer;
}

}  // namespace cosserat_cable::generator
