// One record against the simulation with each channel turned, scaled, moved or exchanged: what a
// slip leaves of it, with the cable's parameters at their best.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/fit/record_model.h"

namespace cosserat_cable {

/// How a channel may differ from what is simulated: record = factor * simulated + constant.
struct ChannelForm {
  int shows = -1;            ///< which simulated column; -1: its own
  bool free_factor = false;  ///< to be found
  double factor = 1;
  bool free_constant = false;  ///< to be found
  double constant = 0;
};

/// All channels of a record, and its clock.
struct RecordForm {
  std::vector<ChannelForm> channels;
  bool free_delay = false;
  double delay = 0;  ///< [s] by which the record is late
  int delayed = -1;  ///< the only channel that is; -1: all are
  bool free_rate = false;
  double rate = 0;  ///< by which its clock runs fast from the start on, relative
};

/// What a form leaves, at the best parameters found.
struct FormFit {
  bool ok = false;
  Eigen::VectorXd at;    ///< logarithms of the parameters
  RecordForm form;       ///< with what was free filled in
  Eigen::VectorXd left;  ///< by channel: mean square over the level's square
  double cost = 0;       ///< what was made small, by sample
  double named = 0;      ///< a parameter that was looked for beside the set's
  double mean() const { return left.size() > 0 ? left.mean() : 0.0; }
};

class SlipModel {
 public:
  /// `level`: of the channels' noise. `points`: values of parameters by name to begin from besides
  /// the set's; `near`: from nowhere else. `stop`, asked in any thread, ends simulations, which
  /// have failed then.
  SlipModel(const MeasurementSet& set, int experiment, const Eigen::VectorXd& level,
            const Eigen::MatrixXd& usable,
            const std::vector<std::vector<std::pair<std::string, double>>>& points,
            const std::function<bool()>& stop, bool near = false);
  ~SlipModel();

  bool ok() const { return ok_; }
  /// The simulated column of this axis beside the channel, or -1 where its quantity has no axes.
  int ColumnOf(int channel, int axis) const;
  /// By how much a record may be late or early [s].
  double LongestDelay() const { return latest_; }
  double EarliestDelay() const { return earliest_; }
  double period() const { return period_; }
  /// From now on simulations are without what the steps in space and time do at a fit's parameters.
  bool Refine(const FormFit& fit) const;
  /// Of the cable's parameters that are fitted, the value in a fit; nothing where it is not.
  std::optional<double> ValueOf(const std::string& name, const FormFit& fit) const;
  /// All of them.
  std::vector<std::pair<std::string, double>> ValuesOf(const FormFit& fit) const;

  /// The record as it is.
  RecordForm Plain() const;
  /// The record as it is, at these parameters; others stay at the set's.
  FormFit At(const std::vector<std::pair<std::string, double>>& values) const;
  /// At the best of the points, over the first part of the record.
  FormFit Look(const RecordForm& form) const;
  /// Fitted from there to a longer part (`whole`: to all of the record).
  FormFit Fit(const FormFit& from, bool whole) const;
  /// The form without freedom, in the place of a fit's.
  FormFit With(const FormFit& fit, const RecordForm& form) const;
  /// Mean square of each channel over the level's, of the whole record at the fit's parameters.
  FormFit Judge(const FormFit& fit) const;

 private:
  struct Part {
    double until = 0;  ///< of the record [s]
    Eigen::Index rows = 0;
  };
  Part Later(Part part, const RecordForm& form) const;
  Eigen::VectorXd Logarithms(const std::vector<std::pair<std::string, double>>& named) const;
  std::vector<Eigen::MatrixXd> Simulate(const std::vector<Eigen::VectorXd>& at, double until) const;
  Eigen::MatrixXd Predict(const Eigen::MatrixXd& simulated, const RecordForm& form) const;
  FormFit Measure(const Eigen::VectorXd& at, const Eigen::MatrixXd& simulated, RecordForm form,
                  const Part& part) const;
  FormFit Descend(const FormFit& from, const Part& without_delay, int iterations) const;

  bool ok_ = false;
  Experiment experiment_;  // as the set has it
  Eigen::VectorXd level_;
  Eigen::MatrixXd usable_;
  std::vector<std::vector<int>> axes_;  // by channel: columns of the axes
  std::unique_ptr<Unknowns> unknowns_;
  double LevelOf(Eigen::Index channel, const ChannelForm& form) const;
  Eigen::VectorXd AllOf(const Eigen::VectorXd& at) const;
  std::unique_ptr<RecordModel> model_;  // of the same experiment on an even grid, all axes shown
  Eigen::VectorXd shown_level_;         // of the noise of what it shows
  std::vector<double> grid_;
  std::vector<int> free_;  // unknowns that are fitted
  double earliest_ = 0, latest_ = 0, period_ = 0;
  Part first_, second_, whole_;
  std::vector<Eigen::VectorXd> points_;
  std::vector<Eigen::MatrixXd> looked_;  // simulated at the points, over the first part
};

}  // namespace cosserat_cable
