// Whether parameters differ from record to record by more than noise explains, and by how much.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cosserat_cable/fit/fit.h"
#include "cosserat_cable/fit/noise.h"
#include "cosserat_cable/fit/record_model.h"

namespace cosserat_cable {

/// What is known where a fit ended.
struct FitEnd {
  const Eigen::VectorXd& values;
  const Eigen::VectorXd& residuals;  ///< weighted
  const RecordJacobian& jacobian;
  const std::vector<std::vector<NoiseColour>>& colours;
};

/// Stiffness and damping that differ between the records: those that the fit took to differ
/// already, and of the others the one that differs most clearly, if chance makes that in one of 500
/// sets. A pendulum's damping is taken to differ at its end, which is fastened anew, where D_E is
/// an unknown. The variance is the likeliest, the other unknowns being estimated with it
/// (restricted maximum likelihood, the records linear in the differences).
std::vector<ParameterScatter> FindScatter(const RecordModel& model, const FitEnd& end);

}  // namespace cosserat_cable
