#include "profile.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "cosserat_cable/fit/information.h"

namespace cosserat_cable {
namespace {

const double kSteps[] = {-3, -2, -1, 1, 2, 3};  // in standard deviations
// The others are fitted when they can gain no more deviance than this; by so many rounds.
constexpr double kSettled = 0.02;
constexpr int kRounds = 6;
// Of the curvature's interval, to each side.
constexpr double kNarrowest = 0.5;

/// The unknowns that follow one that is moved, and how.
struct Followers {
  std::vector<int> which;
  Eigen::LDLT<Eigen::MatrixXd> normal;
  double widening = 1;  ///< of the profiled unknown's variance, by the noise's colour
};

Followers FollowersOf(int i, const Optimum& optimum, const Eigen::MatrixXd& gram) {
  Followers followers;
  for (int k = 0; k < gram.rows(); ++k)
    if (k != i && optimum.covariance(k, k) > 0 && gram(k, k) > 0) followers.which.push_back(k);
  const auto n = static_cast<Eigen::Index>(followers.which.size());
  Eigen::MatrixXd part(n, n);
  Eigen::VectorXd with(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    with[a] = gram(followers.which[a], i);
    for (Eigen::Index b = 0; b < n; ++b) part(a, b) = gram(followers.which[a], followers.which[b]);
  }
  double alone = gram(i, i);
  if (n > 0) {
    followers.normal.compute(part);
    alone -= with.dot(followers.normal.solve(with));
  }
  followers.widening = optimum.covariance(i, i) * std::max(alone, 1e-300);
  return followers;
}

/// A value of the profile on its way.
struct Place {
  std::size_t profile;
  double value;
  Eigen::VectorXd at;
  double cost = 0;  ///< sum of squares, less what one more step would gain
  bool found = false;
};

}  // namespace

std::vector<Profile> FindProfiles(const RecordModel& model, const Optimum& optimum,
                                  const NoiseLevels& noise, const std::vector<int>& which) {
  const Unknowns& unknowns = model.unknowns();
  const int n = unknowns.size();
  const Eigen::MatrixXd gram = optimum.jacobian.Gram();
  std::vector<Followers> followers;
  std::vector<Place> places;
  const auto clamp = [&](int k, double value) {
    return std::clamp(value, unknowns.all()[k].lower, unknowns.all()[k].upper);
  };
  for (std::size_t p = 0; p < which.size(); ++p) {
    const int i = which[p];
    followers.push_back(FollowersOf(i, optimum, gram));
    const double sd = std::sqrt(optimum.covariance(i, i));
    for (const double step : kSteps) {
      // The others where they are best for this one, as far as the derivatives know.
      const Eigen::VectorXd move = optimum.covariance.col(i) / sd * step;
      Place place{p, 0, optimum.values};
      for (int k = 0; k < n; ++k)
        place.at[k] = clamp(k, place.at[k] + move[k] * unknowns.all()[k].scale);
      place.value = place.at[i];
      if (place.value != optimum.values[i]) places.push_back(place);  // else it is at its bound
    }
  }
  std::vector<Place*> left;
  for (Place& place : places) left.push_back(&place);
  for (int round = 0; round < kRounds && !left.empty(); ++round) {
    std::vector<Eigen::VectorXd> points;
    for (const Place* place : left) points.push_back(place->at);
    const std::vector<RecordModel::Simulated> all = model.Simulate(points, model.WholeHorizon());
    std::vector<Place*> next;
    for (std::size_t k = 0; k < left.size(); ++k) {
      if (!all[k].ok) continue;
      Place& place = *left[k];
      const Followers& others = followers[place.profile];
      const Eigen::VectorXd r = WeightedResiduals(model, place.at, all[k].records, noise);
      const Eigen::VectorXd slope = optimum.jacobian.TransposeTimes(r);
      Eigen::VectorXd gradient(static_cast<Eigen::Index>(others.which.size()));
      for (std::size_t o = 0; o < others.which.size(); ++o)
        gradient[static_cast<Eigen::Index>(o)] = slope[others.which[o]];
      double gain = 0;
      if (!others.which.empty()) {
        const Eigen::VectorXd move = -others.normal.solve(gradient);
        gain = -gradient.dot(move);
        for (std::size_t o = 0; o < others.which.size(); ++o) {
          const int u = others.which[o];
          place.at[u] =
              clamp(u, place.at[u] + move[static_cast<Eigen::Index>(o)] * unknowns.all()[u].scale);
        }
      }
      place.cost = r.squaredNorm() - gain;
      place.found = gain < kSettled * others.widening;
      if (!place.found) next.push_back(&place);
    }
    left = std::move(next);
  }

  const double least = optimum.residuals.squaredNorm();
  std::vector<Profile> profiles(which.size());
  for (std::size_t p = 0; p < which.size(); ++p) {
    Profile& profile = profiles[p];
    const auto add = [&](double value, double deviance) {
      profile.value.push_back(value);
      profile.deviance.push_back(deviance);
    };
    bool middle = false;
    for (const Place& place : places) {
      if (place.profile != p || !place.found) continue;
      if (!middle && place.value > optimum.values[which[p]]) {
        add(optimum.values[which[p]], 0);
        middle = true;
      }
      add(place.value, std::max(0.0, (place.cost - least) / followers[p].widening));
    }
    if (!middle) add(optimum.values[which[p]], 0);
  }
  return profiles;
}

std::optional<std::pair<double, double>> IntervalOf(const Profile& profile, double value,
                                                    double sd) {
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
  const std::pair<double, double> ends{at(-kNormal95), at(kNormal95)};
  if (std::min(value - ends.first, ends.second - value) < kNarrowest * kNormal95 * sd)
    return std::nullopt;
  return ends;
}

}  // namespace cosserat_cable
