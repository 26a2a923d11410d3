// Least squares to their very end, from points that are near it: several at once, each with some
// unknowns held.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fit.h"

namespace cosserat_cable {

struct RefitJob {
  Eigen::VectorXd values;    ///< where it begins
  std::vector<bool> held;    ///< by unknown; empty: none is
  Eigen::MatrixXd jacobian;  ///< near `values`, as WeightedJacobian has it; empty: it is found
  double tolerance = 1e-3;   ///< gain in the sum of squares that is not worth a step
};

struct Refitted {
  bool ok = false;  ///< false: the first point cannot be simulated
  bool interrupted = false;
  Eigen::VectorXd values;
  Eigen::VectorXd residuals;  ///< weighted
  Eigen::MatrixXd jacobian;   ///< the last one that was used
  double cost = 0;            ///< sum of squares
  double left = 0;            ///< what the derivatives promise that further steps would gain
};

/// Levenberg and Marquardt's steps: several dampings are tried side by side, and the derivatives
/// are renewed where they promise more than the steps keep. A fit's own end may be a step that was
/// cut short; here it is where no further step gains anything. Unknowns that move no record by more
/// than its noise stay where they are: their derivatives are rounding, and would lead astray.
std::vector<Refitted> Refit(const RecordModel& model, const NoiseLevels& noise,
                            const std::vector<RefitJob>& jobs, const FitProgress& progress);

/// What the derivatives promise that a free step from these residuals would gain in the sum of
/// squares, the unknowns in `held` left where they are.
double PromisedGain(const RecordModel& model, const Eigen::VectorXd& values,
                    const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                    const std::vector<bool>& held);

}  // namespace cosserat_cable
