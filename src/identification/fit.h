// Least squares of the records on what is simulated.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "cosserat_cable/identification/record_model.h"

namespace cosserat_cable {

/// Standard deviation of the noise, by experiment and channel.
using NoiseLevels = std::vector<Eigen::VectorXd>;

/// Called with what is going on; false stops the fit.
using FitProgress = std::function<bool(const std::string& what)>;

/// What a channel's noise is taken to be at least [the channel's unit].
double SmallestNoise(const Experiment& experiment, int channel);

/// Before any fit: as the set gives it, otherwise from how rough the records are.
NoiseLevels GuessNoise(const RecordModel& model);

/// One over the standard deviation of each sample of an experiment: of its noise, and of what the
/// simulation may be off there. Zero where no sensor measured.
Eigen::MatrixXd SampleWeights(const RecordModel& model, std::size_t experiment,
                              const NoiseLevels& noise);

/// Residuals (measured less simulated, by SampleWeights) one below the other: experiment by
/// experiment, channel by channel, then what is known beforehand.
Eigen::VectorXd WeightedResiduals(const RecordModel& model, const Eigen::VectorXd& values,
                                  const Records& simulated, const NoiseLevels& noise);
/// The first of the residuals of an experiment; of one past the last, that of what is known
/// beforehand.
int FirstRow(const RecordModel& model, int experiment);
/// Their derivatives by the unknowns in units of the unknowns' scales.
Eigen::MatrixXd WeightedJacobian(const RecordModel& model,
                                 const RecordModel::Derivatives& derivatives,
                                 const NoiseLevels& noise);

struct FitResult {
  bool ok = false;
  bool interrupted = false;
  std::string message;
  Eigen::VectorXd values;
  double cost = 0;  ///< half the sum of squares
  int iterations = 0;
  Eigen::MatrixXd jacobian;  ///< WeightedJacobian near the end
};

/// Levenberg and Marquardt's method (Ceres) from `values`, with the unknowns in their bounds.
struct FitOptions {
  bool loose = false;     ///< on the way, not to the end
  std::vector<int> held;  ///< unknowns that stay
};
FitResult Fit(const RecordModel& model, const Eigen::VectorXd& values, const Horizon& horizon,
              const NoiseLevels& noise, const FitOptions& options, const FitProgress& progress);

/// The last small steps to a minimum that is near, with the derivatives as they were there: Gauss
/// and Newton's. False where they lead nowhere; `values` are left as they were then.
bool Polish(const RecordModel& model, const Eigen::MatrixXd& jacobian, const NoiseLevels& noise,
            Eigen::VectorXd* values);

/// From nowhere near: points spread around the start and `more` on the first part of the records,
/// the best of them fitted to longer and longer parts, so that no swing is taken for the next.
/// Unknown starts are found from the first part of a period before. On the way, unknowns that an
/// experiment does not show are ignored there.
FitResult FitFromAfar(RecordModel* model, const std::vector<Eigen::VectorXd>& more,
                      const NoiseLevels& noise, const FitProgress& progress);

}  // namespace cosserat_cable
