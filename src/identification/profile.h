// The likelihood along one unknown, with all others at their best.
#pragma once

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "cosserat_cable/identification/estimation.h"
#include "fit.h"

namespace cosserat_cable {

/// What is known at the optimum.
struct Optimum {
  Eigen::VectorXd values;
  Eigen::VectorXd residuals;   ///< weighted
  Eigen::MatrixXd jacobian;    ///< by units of the scales
  Eigen::MatrixXd covariance;  ///< likewise, the noise's colour counted
};

/// Of which unknown, and to which root of its deviance the profile should reach: the quantile of
/// the interval that is wanted.
struct ProfileRequest {
  int unknown = 0;
  double reach = 1.959964;
};

struct Profiles {
  std::vector<Profile> profiles;  ///< by request; empty where the simulation fails
  /// A point of a profile that is better than the optimum: that was none.
  std::optional<Eigen::VectorXd> better;
  bool interrupted = false;
};

/// Profiles of some unknowns: step by step to both sides, each point minimised over all others with
/// a variance (unknown starts, offsets, what differs between records, ...), from where the points
/// before lead. Deviances are divided by what the noise's colour widens the covariance.
Profiles FindProfiles(const RecordModel& model, const Optimum& optimum, const NoiseLevels& noise,
                      const std::vector<ProfileRequest>& requests, const FitProgress& progress);

/// Ends of the interval: where the root of the deviance is `quantile`, or `lower`, the bound of the
/// unknown, where the profile ends there before. Nothing where the profile does not rise to both
/// sides of the value, or not far enough.
std::optional<std::pair<double, double>> IntervalOf(
    const Profile& profile, double value, double quantile,
    double lower = -std::numeric_limits<double>::infinity());

}  // namespace cosserat_cable
