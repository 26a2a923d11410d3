// A measurement set and what is free in it, as one problem of maximum likelihood: fits from afar or
// from another fit's end, residuals against noise levels that no fit has chosen, derivatives, and
// the prediction of records that were held out.
//
//     FitProblem problem(set, options, &problems);
//     FitPoint plain = problem.FitFromAfar();
//     FitProblem more(extended_set, options, &problems);
//     more.ShareSteps(problem);
//     FitPoint extended = more.FitFrom(plain, {{"extensions.air_drag.Cd", 0.01}});
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cosserat_cable/fit/fit.h"
#include "cosserat_cable/fit/noise.h"
#include "cosserat_cable/fit/noise_level.h"
#include "cosserat_cable/fit/record_model.h"

namespace cosserat_cable {

struct FitProblemOptions {
  UnknownOptions unknowns;
  std::vector<int> held_out;      ///< experiments whose records count for nothing
  NoiseLevels noise;              ///< empty: SetNoise of the set
  std::vector<std::string> held;  ///< unknowns that stay in warm fits
  int max_iterations = 0;         ///< of a warm fit; 0: as many as it takes
  bool quick = false;             ///< of a warm fit: a few steps by the start's derivatives
  double aim = 0;                 ///< of a warm fit: the sum of squares to be reached; 0: none
  std::function<bool()> stop;
  FitProgress progress;
};

/// The noise of a set's channels, by experiment, independent of any fit.
struct SetNoise {
  NoiseLevels levels;
  std::vector<std::vector<NoiseLevel>> sources;
  bool known = true;  ///< false: of a channel not even an upper bound is known
};
SetNoise NoiseOf(const MeasurementSet& set, const Records& simulated = {});

/// Where a fit ended, or any point of the parameters.
struct FitPoint {
  bool ok = false;
  bool interrupted = false;
  bool at_minimum = false;
  std::string message;  ///< why it is not ok
  std::vector<Unknown> unknowns;
  Eigen::VectorXd values;
  Records simulated;
  Records residuals;        ///< measured less simulated, over the noise's standard deviation
  NoiseLevels noise;        ///< that standard deviation
  double cost = 0;          ///< their sum of squares [noise variances], held-out records left out
  double samples = 0;       ///< how many of them
  RecordJacobian jacobian;  ///< of the residuals by the unknowns in units of their scales
  int iterations = 0;

  /// NaN where there is no such unknown.
  double ValueOf(const std::string& name) const;
};

/// What a point says of itself, its noise taken to be coloured as its residuals are.
struct Likelihood {
  double log_likelihood = 0;
  double samples = 0;  ///< independent ones: those that count, by how many in a row are worth one
  double freedom = 0;  ///< of them, less the unknowns that the records show
  Records whitened;    ///< residuals; zero where a sample does not count
};
Likelihood LikelihoodOf(const FitPoint& point);

class FitProblem {
 public:
  /// Mistakes of the set go to `problems`; then the problem is not to be used.
  FitProblem(const MeasurementSet& set, const FitProblemOptions& options, Problems* problems);

  const Unknowns& unknowns() const { return *unknowns_; }
  const NoiseLevels& noise() const { return noise_; }
  const RecordModel& model() const { return *model_; }
  SimulationCount count() const { return model_->count(); }

  /// What steps in space and time make of the records is taken from a problem of the same set, and
  /// so are the shapes of unknown starts.
  void ShareSteps(const FitProblem& other) {
    model_->TakeStepsFrom(*other.model_);
    ShareShapes(other);
  }
  void ShareShapes(const FitProblem& other) { unknowns_->ShareShapes(*other.unknowns_); }
  /// Found anew at a point: as fine as the larger of the noise and what is left there asks.
  void Refine(const FitPoint& at);

  /// Where what the steps still do moves the unknowns, the next Refine compares with finer ones.
  /// Not where far more than noise is left: that takes no precision to see.
  /// @return whether it does anywhere
  bool Sharpen(const FitPoint& at);

  /// Warm fits from now on are thorough, with so many iterations; 0: as many as it takes.
  void SetMaxIterations(int count) {
    options_.max_iterations = count;
    options_.quick = false;
  }
  /// Unknowns that stay where a warm fit begins.
  void SetHeld(std::vector<std::string> names) { options_.held = std::move(names); }
  /// The sum of squares that a warm fit is to reach, to be worth its end; 0: none.
  void SetAim(double cost) { options_.aim = cost; }

  /// From the set's own values and points around them.
  FitPoint FitFromAfar();
  /// From another problem's point: unknowns of the same name start there, `also` by name, the
  /// others at their own start.
  FitPoint FitFrom(const FitPoint& start, const std::map<std::string, double>& also = {});
  /// The same, but nothing is found out at the end except the values.
  FitPoint ValuesFrom(const FitPoint& start);
  /// The point itself, with derivatives.
  FitPoint At(const Eigen::VectorXd& values);
  /// The values with which FitFrom begins.
  Eigen::VectorXd StartFrom(const FitPoint& start, const std::map<std::string, double>& also) const;

  /// What belongs to a held-out experiment alone (its start, its offsets) is found from the
  /// beginning of its record, all else as it is. @return its residuals after that beginning, empty
  /// where it cannot be simulated
  Eigen::MatrixXd Predict(const FitPoint& at, int experiment) const;

 private:
  FitPoint PointOf(const FitResult& fit);
  /// `steps`: of the differences; may be empty.
  FitPoint PointAt(const Eigen::VectorXd& values, Eigen::VectorXd steps);
  FitPoint PointOf(const Eigen::VectorXd& values, Records simulated, RecordJacobian jacobian) const;
  bool IsHeldOut(std::size_t experiment) const;
  RecordJacobian KnownFrom(const FitPoint& start) const;
  FitResult WarmFit(const FitPoint& start, const std::map<std::string, double>& also, bool finish);

  FitProblemOptions options_;
  std::unique_ptr<Unknowns> unknowns_;
  std::unique_ptr<RecordModel> model_;
  NoiseLevels noise_;
};

}  // namespace cosserat_cable
