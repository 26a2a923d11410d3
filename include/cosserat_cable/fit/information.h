// What a fit's derivatives say about the unknowns: covariance, and which of them the data
// determine.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cosserat_cable/fit/fit.h"
#include "cosserat_cable/fit/noise.h"

namespace cosserat_cable {

/// Half of a normal distribution's 95 % interval, in standard deviations.
constexpr double kNormal95 = 1.959964;

/// Information matrices in units of the unknowns' scales.
struct Information {
  Eigen::MatrixXd expected;  ///< of white noise of the levels used: J^T J
  Eigen::MatrixXd scatter;   ///< of the score under the noise's own size and colour
};

/// `jacobian` as WeightedJacobian has it; `colours` by experiment and channel, of the weighted
/// residuals.
Information InformationOf(const RecordModel& model, const RecordJacobian& jacobian,
                          const std::vector<std::vector<NoiseColour>>& colours);

/// The same of one experiment's record alone.
Information InformationOfRecord(const RecordModel& model, const RecordJacobian& jacobian,
                                const std::vector<std::vector<NoiseColour>>& colours,
                                int experiment);

/// expected^-1 scatter expected^-1 over the unknowns in `which`, zero elsewhere.
Eigen::MatrixXd CovarianceOf(const Information& information, const std::vector<int>& which);

/// What the data do say about parameters that they do not determine one by one.
struct Combination {
  std::string text;  ///< "eta_GJ/L + D_E"
  double value = 0, sd = 0;
  std::string unit;
};

struct Determination {
  std::vector<int> determined;       ///< indices
  std::vector<std::string> reasons;  ///< by unknown; empty where determined
  std::vector<Combination> combinations;
  Eigen::MatrixXd covariance;  ///< in units of the scales, of the determined ones
};

/// Takes out, one after the other, what the data do not determine: unknowns that move no record by
/// more than its noise, then those that only show together with another.
Determination Determine(const RecordModel& model, const Eigen::VectorXd& values,
                        const Information& information);

}  // namespace cosserat_cable
