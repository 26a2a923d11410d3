#include "profile.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

constexpr double kNormal95 = 1.959964;
const double kSteps[] = {-3, -2, -1, 1, 2, 3};  // in standard deviations

}  // namespace

std::vector<Profile> FindProfiles(const RecordModel& model, const Optimum& optimum,
                                  const NoiseLevels& noise, const std::vector<int>& which) {
  const Unknowns& unknowns = model.unknowns();
  const int n = unknowns.size();
  const Eigen::MatrixXd information = optimum.jacobian.transpose() * optimum.jacobian;
  std::vector<Eigen::VectorXd> points;
  for (const int i : which) {
    const double sd = std::sqrt(optimum.covariance(i, i));
    for (const double step : kSteps) {
      // The others where they are best for this one, as far as the derivatives know.
      Eigen::VectorXd move = optimum.covariance.col(i) / optimum.covariance(i, i) * (step * sd);
      Eigen::VectorXd point = optimum.values;
      for (int k = 0; k < n; ++k) {
        const Unknown& u = unknowns.all()[k];
        point[k] = std::clamp(point[k] + move[k] * u.scale, u.lower, u.upper);
      }
      points.push_back(point);
    }
  }
  const std::vector<RecordModel::Simulated> all = model.Simulate(points, model.WholeHorizon());
  const double least = optimum.residuals.squaredNorm();
  std::vector<Profile> profiles;
  std::size_t p = 0;
  for (const int i : which) {
    // Unknowns that follow.
    std::vector<int> others;
    for (int k = 0; k < n; ++k)
      if (k != i && optimum.covariance(k, k) > 0) others.push_back(k);
    Eigen::MatrixXd J(optimum.jacobian.rows(), others.size());
    for (std::size_t k = 0; k < others.size(); ++k) J.col(k) = optimum.jacobian.col(others[k]);
    const Eigen::LDLT<Eigen::MatrixXd> normal(J.transpose() * J);
    // Variance as the plain likelihood has it, against the true one.
    Eigen::VectorXd column = optimum.jacobian.col(i);
    if (!others.empty()) column -= J * normal.solve(J.transpose() * column);
    const double plain = 1 / std::max(column.squaredNorm(), 1e-300);
    const double widening = optimum.covariance(i, i) / plain;

    Profile profile;
    const auto add = [&](double value, double deviance) {
      profile.value.push_back(value);
      profile.deviance.push_back(deviance);
    };
    for (const double step : kSteps) {
      const RecordModel::Simulated& simulated = all[p];
      const double value = points[p][i];
      if (step > 0 && profile.value.size() == std::size(kSteps) / 2) add(optimum.values[i], 0);
      if (simulated.ok) {
        const Eigen::VectorXd r = WeightedResiduals(model, points[p], simulated.records, noise);
        double cost = r.squaredNorm();
        if (!others.empty()) {
          const Eigen::VectorXd gradient = J.transpose() * r;
          cost -= gradient.dot(normal.solve(gradient));
        }
        const bool stuck = value == optimum.values[i];  // at a bound
        if (!stuck) add(value, std::max(0.0, (cost - least) / widening));
      }
      ++p;
    }
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

std::optional<std::pair<double, double>> IntervalOf(const Profile& profile, double value) {
  // Along the signed root of the deviance, which is straight where the problem is linear.
  std::vector<std::pair<double, double>> roots;  // value, root
  for (std::size_t k = 0; k < profile.value.size(); ++k)
    roots.push_back({profile.value[k],
                     std::copysign(std::sqrt(profile.deviance[k]), profile.value[k] - value)});
  std::sort(roots.begin(), roots.end());
  for (std::size_t k = 1; k < roots.size(); ++k)
    if (!(roots[k].second > roots[k - 1].second)) return std::nullopt;
  if (roots.size() < 3 || roots.front().second > -1 || roots.back().second < 1) return std::nullopt;
  const auto at = [&](double root) {
    std::size_t k = 1;
    while (k + 1 < roots.size() && roots[k].second < root) ++k;
    const auto& [v0, r0] = roots[k - 1];
    const auto& [v1, r1] = roots[k];
    return v0 + (root - r0) / (r1 - r0) * (v1 - v0);
  };
  return std::pair{at(-kNormal95), at(kNormal95)};
}

}  // namespace cosserat_cable
