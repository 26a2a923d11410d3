#include "profile.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "refit.h"

namespace cosserat_cable {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// To each side: of a standard deviation, always; of twice the last, where the deviance is still
// small then.
constexpr int kSteps = 3, kMostSteps = 7;
// A deviance below this is flat: so much the minimisation leaves.
constexpr double kFlat = 0.03;
// Of the sum of squares: at the ends of an interval this moves them by a few thousandths of their
// distance. A gain beyond shows a better optimum.
constexpr double kProfileTolerance = 0.02, kBetter = 0.1;
// An interval is not extrapolated from a profile that ends before this root of its deviance.
constexpr double kLeastReach = 1;

/// A profile on its way to one side of the optimum.
struct Side {
  std::size_t request = 0;
  double direction = 1;
  VectorXd before, at;  // the last two points
  VectorXd target;      // where the next begins
  int steps = 0;
  bool done = false;
};

class Profiler {
 public:
  Profiler(const RecordModel& model, const Optimum& optimum, const NoiseLevels& noise,
           const std::vector<ProfileRequest>& requests)
      : model_(model), optimum_(optimum), noise_(noise), requests_(requests) {
    found_.profiles.resize(requests.size());
    for (std::size_t k = 0; k < requests.size(); ++k) {
      widening_.push_back(WideningOf(requests[k].unknown));
      found_.profiles[k].value = {optimum.values[requests[k].unknown]};
      found_.profiles[k].deviance = {0.0};
      for (const double direction : {-1.0, 1.0})
        sides_.push_back({k, direction, optimum.values, optimum.values, {}, 0, false});
    }
  }

  Profiles Find(const FitProgress& progress) {
    while (!found_.interrupted && Advance(progress)) {
    }
    for (Profile& profile : found_.profiles) Sort(&profile);
    return found_;
  }

 private:
  bool Follows(int unknown) const { return optimum_.covariance(unknown, unknown) > 0; }
  const std::vector<Unknown>& unknowns() const { return model_.unknowns().all(); }

  /// Variance of the unknown against the one that the plain likelihood has.
  double WideningOf(int i) const {
    std::vector<int> others;
    for (int k = 0; k < model_.unknowns().size(); ++k)
      if (k != i && Follows(k)) others.push_back(k);
    VectorXd column = optimum_.jacobian.col(i);
    if (!others.empty()) {
      MatrixXd J(optimum_.jacobian.rows(), static_cast<Eigen::Index>(others.size()));
      for (std::size_t k = 0; k < others.size(); ++k)
        J.col(static_cast<Eigen::Index>(k)) = optimum_.jacobian.col(others[k]).normalized();
      column -= J * J.colPivHouseholderQr().solve(column);
    }
    return optimum_.covariance(i, i) * column.squaredNorm();
  }

  /// Where the side's next point begins; false: at the bound of the unknown already.
  bool Aim(Side* side) const {
    const int i = requests_[side->request].unknown;
    const Unknown& own = unknowns()[static_cast<std::size_t>(i)];
    const double sd = std::sqrt(optimum_.covariance(i, i)) * own.scale;
    const double step = side->direction * sd * std::pow(2, std::max(0, side->steps - kSteps + 1));
    const double goal = std::clamp(side->at[i] + step, own.lower, own.upper);
    if (goal == side->at[i]) return false;
    VectorXd move;  // of all, as this one makes it
    if (side->steps == 0) {
      // As far as the derivatives know.
      move = optimum_.covariance.col(i) / optimum_.covariance(i, i);
      for (int k = 0; k < move.size(); ++k)
        move[k] *= unknowns()[static_cast<std::size_t>(k)].scale / own.scale;
    } else {
      move = (side->at - side->before) / (side->at[i] - side->before[i]);
    }
    side->target = side->at + move * (goal - side->at[i]);
    for (int k = 0; k < move.size(); ++k)
      side->target[k] = std::clamp(side->target[k], unknowns()[static_cast<std::size_t>(k)].lower,
                                   unknowns()[static_cast<std::size_t>(k)].upper);
    side->target[i] = goal;
    return true;
  }

  /// One step of every side. False: all have arrived.
  bool Advance(const FitProgress& progress) {
    std::vector<RefitJob> jobs;
    std::vector<Side*> whose;
    for (Side& side : sides_) {
      if (!side.done) side.done = !Aim(&side);
      if (side.done) continue;
      RefitJob job;
      job.values = side.target;
      job.jacobian = optimum_.jacobian;
      job.tolerance = kProfileTolerance;
      for (int k = 0; k < model_.unknowns().size(); ++k)
        job.held.push_back(k == requests_[side.request].unknown || !Follows(k));
      jobs.push_back(std::move(job));
      whose.push_back(&side);
    }
    if (jobs.empty()) return false;
    const std::vector<Refitted> results = Refit(model_, noise_, jobs, progress);
    for (std::size_t k = 0; k < results.size(); ++k) {
      found_.interrupted |= results[k].interrupted;
      Take(results[k], whose[k]);
    }
    return true;
  }

  void Take(const Refitted& result, Side* side) {
    if (!result.ok) {
      side->done = true;
      return;
    }
    const double least = optimum_.residuals.squaredNorm();
    if (result.cost < least - kBetter && result.cost < best_) {
      best_ = result.cost;
      found_.better = result.values;
    }
    const double deviance = std::max(0.0, (result.cost - least) / widening_[side->request]);
    Profile& profile = found_.profiles[side->request];
    profile.value.push_back(result.values[requests_[side->request].unknown]);
    profile.deviance.push_back(deviance);
    side->before = side->at;
    side->at = result.values;
    ++side->steps;
    const bool reached = std::sqrt(deviance) > requests_[side->request].reach;
    side->done = side->steps >= kMostSteps || (side->steps >= kSteps && reached);
  }

  static void Sort(Profile* profile) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t k = 0; k < profile->value.size(); ++k)
      points.push_back({profile->value[k], profile->deviance[k]});
    std::sort(points.begin(), points.end());
    for (std::size_t k = 0; k < points.size(); ++k) {
      profile->value[k] = points[k].first;
      profile->deviance[k] = points[k].second;
    }
  }

  const RecordModel& model_;
  const Optimum& optimum_;
  const NoiseLevels& noise_;
  const std::vector<ProfileRequest>& requests_;
  std::vector<double> widening_;  // by request
  std::vector<Side> sides_;
  double best_ = std::numeric_limits<double>::infinity();
  Profiles found_;
};

}  // namespace

Profiles FindProfiles(const RecordModel& model, const Optimum& optimum, const NoiseLevels& noise,
                      const std::vector<ProfileRequest>& requests, const FitProgress& progress) {
  return Profiler(model, optimum, noise, requests).Find(progress);
}

std::optional<std::pair<double, double>> IntervalOf(const Profile& profile, double value,
                                                    double quantile, double lower) {
  // Along the signed root of the deviance, which is straight where the problem is linear.
  std::vector<std::pair<double, double>> roots;  // value, root
  bool bounded = false;
  for (std::size_t k = 0; k < profile.value.size(); ++k) {
    const double root = std::sqrt(profile.deviance[k]);
    bounded = bounded || (profile.value[k] <= lower && root < quantile);
    if (profile.value[k] == value)
      roots.push_back({value, 0.0});
    else if (profile.deviance[k] > kFlat)
      roots.push_back({profile.value[k], std::copysign(root, profile.value[k] - value)});
  }
  std::sort(roots.begin(), roots.end());
  for (std::size_t k = 1; k < roots.size(); ++k)
    if (!(roots[k].second > roots[k - 1].second)) return std::nullopt;
  if (roots.size() < 2) return std::nullopt;
  if (!bounded && roots.front().second > -kLeastReach) return std::nullopt;
  if (roots.back().second < kLeastReach) return std::nullopt;
  const auto at = [&](double root) {
    std::size_t k = 1;
    while (k + 1 < roots.size() && roots[k].second < root) ++k;
    const auto& [v0, r0] = roots[k - 1];
    const auto& [v1, r1] = roots[k];
    return v0 + (root - r0) / (r1 - r0) * (v1 - v0);
  };
  return std::pair{bounded ? lower : at(-quantile), at(quantile)};
}

}  // namespace cosserat_cable
