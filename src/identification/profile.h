// The likelihood along one unknown, with all others at their best.
#pragma once

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

/// Profiles of some unknowns: the others follow along the linear path, and by one step of Gauss
/// and Newton from there, whose gain counts. Deviances are divided by what the noise's colour
/// widens the covariance.
std::vector<Profile> FindProfiles(const RecordModel& model, const Optimum& optimum,
                                  const NoiseLevels& noise, const std::vector<int>& which);

/// Ends of the 95 % interval: where the deviance is 3.84. Nothing where the profile does not rise
/// to both sides of the value, or not far enough.
std::optional<std::pair<double, double>> IntervalOf(const Profile& profile, double value);

}  // namespace cosserat_cable
