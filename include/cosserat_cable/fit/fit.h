// Least squares of the records on what is simulated.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "cosserat_cable/fit/record_jacobian.h"
#include "cosserat_cable/fit/record_model.h"

namespace cosserat_cable {

/// Called with what is going on; false stops the fit.
using FitProgress = std::function<bool(const std::string& what)>;

/// A derivative whose records, over the unknown's whole size, stay below this part of the noise's
/// sum of squares is none.
inline constexpr double kUnseen = 1e-3;

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
RecordJacobian WeightedJacobian(const RecordModel& model,
                                const RecordModel::Derivatives& derivatives,
                                const NoiseLevels& noise);

/// What is left at values of the unknowns, and how it changes with them.
struct Linearised {
  bool ok = false;
  std::string message;
  Records simulated;
  Eigen::VectorXd residuals;  ///< WeightedResiduals
  RecordJacobian jacobian;
  std::vector<double> other_costs;  ///< half the sums of squares at the other points
  bool whole = true;                ///< false: some derivatives are older than the rest
};
/// `steps`, of the differences in the unknowns' scales, are made to suit: large enough to rise
/// above rounding, with an effect of some part of the noise at most. `again`: what they turned out
/// to be unsuitable for is differentiated once more. `others` are simulated beside. Derivatives are
/// taken from `known` where they are there.
Linearised Linearise(const RecordModel& model, const Eigen::VectorXd& values,
                     const Horizon& horizon, const NoiseLevels& noise,
                     RecordModel::Difference difference, bool again, Eigen::VectorXd* steps,
                     const std::vector<Eigen::VectorXd>& others = {},
                     const RecordJacobian* known = nullptr);

struct FitResult {
  bool ok = false;
  bool interrupted = false;
  bool at_minimum = false;  ///< nothing that counts beside the noise can be gained
  bool is_far = false;      ///< the aim is out of reach
  std::string message;
  Eigen::VectorXd values;
  double cost = 0;       ///< half the sum of squares
  double gain_left = 0;  ///< of it, as far as the derivatives know, by the noise that is left
  int iterations = 0;
  RecordJacobian jacobian;   ///< near the end
  bool is_jacobian = false;  ///< of the values themselves, and whole
  Eigen::VectorXd steps;     ///< of the differences
};

struct FitOptions {
  bool loose = false;  ///< on the way, not to the end
  /// Whether what counts is measured by the noise; otherwise by what is left.
  bool to_noise = true;
  std::vector<int> held;   ///< unknowns that stay
  int max_iterations = 0;  ///< 0: as many as it takes
  Eigen::VectorXd steps;   ///< of the differences, from a fit before; may be empty
  /// Derivatives from a fit before; may be empty. They serve on the way, as long as they lead on.
  RecordJacobian known;
  /// All of them do, corrected on the way; otherwise those by what concerns one experiment only:
  /// they change least, and there are many of them.
  bool quick = false;
  bool finish = true;  ///< false: an end by such derivatives will do
  /// Half a sum of squares that is to be reached: what is far from it for long does not go on.
  double aim = 0;
};
/// From `values`, with the unknowns in their bounds, to where nothing more can be gained.
FitResult Fit(const RecordModel& model, const Eigen::VectorXd& values, const Horizon& horizon,
              const NoiseLevels& noise, const FitOptions& options, const FitProgress& progress);

/// The last small steps to a minimum that is near, with the derivatives as they were there: Gauss
/// and Newton's. False where they lead nowhere; `values` are left as they were then.
bool Polish(const RecordModel& model, const RecordJacobian& jacobian, const NoiseLevels& noise,
            Eigen::VectorXd* values);

/// From nowhere near: points spread around the start and `more` on the first part of the records,
/// the best of them fitted to longer and longer parts, so that no swing is taken for the next.
/// Unknown starts are found from the first part of a period before. On the way, unknowns that an
/// experiment does not show are ignored there. `rival`, where it is asked for: the end of a search
/// that led to another valley, and no lower; not `ok` where there was none.
FitResult FitFromAfar(RecordModel* model, const std::vector<Eigen::VectorXd>& more,
                      const NoiseLevels& noise, const FitProgress& progress,
                      FitResult* rival = nullptr);

/// Whether two fits of the same records have found the same minimum, as far as the curvature at the
/// better one tells. False where there are no derivatives.
bool InOneValley(const Unknowns& unknowns, const FitResult& best, const FitResult& other);

}  // namespace cosserat_cable
