// The work behind an estimation, step by step, and what it knows on its way.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <string>
#include <vector>

#include "cosserat_cable/fit/fit.h"
#include "cosserat_cable/fit/information.h"
#include "cosserat_cable/fit/noise.h"
#include "cosserat_cable/identification/estimation.h"
#include "profile.h"
#include "record_scatter.h"
#include "stage_clock.h"

namespace cosserat_cable {

/// Residuals of a channel at the samples that `count`.
Eigen::VectorXd CountedResiduals(const Experiment& experiment, const Eigen::MatrixXd& simulated,
                                 const Eigen::MatrixXd& count, int column);

class EstimationWork {
 public:
  /// What is done is charged to `clock`, which the time budget counts from.
  EstimationWork(const Unknowns& unknowns, const EstimationOptions& options, StageClock* clock)
      : unknowns_(unknowns), options_(options), clock_(clock), model_(unknowns) {
    model_.SetStop([this] { return Stopped() || OutOfTime(); });
  }
  EstimationWork(const EstimationWork&) = delete;

  /// False: there is none, and Answer says why.
  bool FitFromStart();
  /// Whether the work ended before its time.
  bool hurried() const { return hurried_; }
  /// Whether what is left is far more than noise.
  bool misfit() const { return misfit_; }
  /// From where another fit ended, which knew less of what differs between records.
  bool FitFrom(const EstimationWork& before);
  std::vector<ParameterScatter> Scatter() const {
    return FindScatter(model_, {optimum_.values, optimum_.residuals, optimum_.jacobian, colours_});
  }
  /// @pre the fit succeeded
  void Report(const std::vector<ParameterScatter>& scatter);
  Estimation Answer() const { return estimation_; }

 private:
  const std::vector<Experiment>& experiments() const { return unknowns_.set().experiments; }
  bool Tell(const std::string& what, double part) {
    if (options_.progress && !options_.progress(what, part)) stopped_ = true;
    return !model_.Stopping();
  }
  NoiseLevel Level(std::size_t experiment, int column) const;
  bool MovesBeyondNoise(std::size_t experiment) const;
  Eigen::MatrixXd Counted(std::size_t experiment) const;
  bool ShownByNone(int unknown) const;
  bool UpdateNoise();
  RecordJacobian KnownOfWhole() const;
  bool FitInRounds();
  bool FitToEnd();
  bool Stopped() const { return stopped_ || (options_.stop && options_.stop()); }
  bool OutOfTime() const {
    return options_.time_budget > 0 && clock_->seconds() > options_.time_budget;
  }
  bool Hurry();
  void LoosenNoise();
  void LeaveOut(std::size_t experiment, const std::string& why);
  void LeaveOutDamaged();
  void LeaveOutShort();
  bool LeaveOutSilent();
  bool Conclude();
  void FindColours();
  double QuantileOf(int unknown, const Determination& determination,
                    const Information& information) const;
  void ReportChannels();
  bool NothingMoves() const;
  void ReportSampling();
  void ReportFarFromGiven();
  void ReportOtherMinimum();
  void KeepDefaults(const Determination& determination);

  const Unknowns& unknowns_;
  const EstimationOptions& options_;
  StageClock* clock_;
  RecordModel model_;
  NoiseLevels noise_;
  Optimum optimum_;
  Eigen::VectorXd steps_;  // of the differences, in the unknowns' scales
  FitResult fit_;          // the last one of whole records
  FitResult rival_;        // the search's second valley; not ok where there was none
  std::atomic<bool> stopped_{false};
  bool hurried_ = false;
  bool misfit_ = false;  // what is left is far more than noise: it takes no precision to see
  std::string end_;      // why the fit is no minimum; empty where it is
  Records simulated_;
  std::vector<std::vector<NoiseColour>> colours_;
  Estimation estimation_;
};

}  // namespace cosserat_cable
