// The likelihood along one unknown, with all others at their best.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "cosserat_cable/fit/fit.h"
#include "cosserat_cable/identification/estimation.h"

namespace cosserat_cable {

/// What is known at the optimum.
struct Optimum {
  Eigen::VectorXd values;
  Eigen::VectorXd residuals;  ///< weighted
  RecordJacobian jacobian;
  Eigen::MatrixXd covariance;  ///< likewise, the noise's colour counted
};

/// Profiles of some unknowns: all others that the records show are fitted anew at each value, by
/// Gauss and Newton's method with the derivatives of the optimum, until nothing that counts is left
/// to gain. Deviances are divided by what the noise's colour widens the covariance. Values at which
/// that does not come to an end are left out.
std::vector<Profile> FindProfiles(const RecordModel& model, const Optimum& optimum,
                                  const NoiseLevels& noise, const std::vector<int>& which);

/// Ends of the 95 % interval: where the deviance is 3.84. Nothing where the profile does not rise
/// to both sides of the value, not far enough, or so fast that a side is narrower than half of that
/// of the curvature's interval, 1.96 `sd`: then it has found its way to another minimum.
std::optional<std::pair<double, double>> IntervalOf(const Profile& profile, double value,
                                                    double sd);

}  // namespace cosserat_cable
