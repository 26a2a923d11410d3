// All records of a set simulated for given values of the unknowns, with derivatives.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/fit/unknowns.h"

namespace cosserat_cable {

/// Per experiment: a row per sample, a column per channel.
using Records = std::vector<Eigen::MatrixXd>;

/// Standard deviation of the noise, by experiment and channel.
using NoiseLevels = std::vector<Eigen::VectorXd>;

/// How far into the records: per experiment, the last time that counts [s].
using Horizon = std::vector<double>;

/// How much was simulated.
struct SimulationCount {
  long simulations = 0;  ///< of one experiment with one cable
  long steps = 0;        ///< of one cable
  long element_steps = 0;

  SimulationCount& operator+=(const SimulationCount& other) {
    simulations += other.simulations;
    steps += other.steps;
    element_steps += other.element_steps;
    return *this;
  }
  SimulationCount operator-(const SimulationCount& other) const {
    return {simulations - other.simulations, steps - other.steps,
            element_steps - other.element_steps};
  }
};

class RecordModel {
 public:
  /// The unknowns outlive this. Works in all cores.
  explicit RecordModel(const Unknowns& unknowns);

  struct Simulated {
    bool ok = true;
    std::string message;
    Records records;
  };

  /// Every experiment for each of several points. Those of an experiment go side by side through
  /// the lanes, experiments through the cores.
  std::vector<Simulated> Simulate(const std::vector<Eigen::VectorXd>& points,
                                  const Horizon& horizon) const;

  /// Derivative of a record by value/scale of an unknown that it shows.
  struct Slope {
    int unknown;
    Eigen::MatrixXd by;
  };
  struct Derivatives {
    Simulated at;
    std::vector<std::vector<Slope>> slopes;  ///< by experiment
    std::vector<Simulated> others;
  };
  enum class Difference { kForward, kCentral };
  /// `steps`: by unknown, of the differences, in its scale. Where a simulation fails on one side,
  /// the other one is taken. `others` are points to be simulated beside. By unknowns that are
  /// `left_out` there are no derivatives.
  Derivatives Differentiate(const Eigen::VectorXd& values, const Horizon& horizon,
                            Difference difference, const Eigen::VectorXd& steps,
                            const std::vector<Eigen::VectorXd>& others = {},
                            const std::vector<bool>& left_out = {}) const;
  /// How many unknowns an experiment shows at most, but for those that are left out.
  int MostShown(const std::vector<bool>& left_out = {}) const;
  /// The steps where nothing is known of how large an effect they have.
  Eigen::VectorXd SmallSteps() const;

  /// Finds at these values what the steps in space and time make of the records, by comparing with
  /// finer runs, and corrects all further simulations by it. Experiments for which they are too far
  /// apart, beside their range and `noise`, are simulated more finely from then on.
  /// @return the largest correction, in parts of its channel's range
  double Refine(const Eigen::VectorXd& values, const NoiseLevels& noise);

  /// What Refine found at another model of the same set, its fineness included. Records here may
  /// end earlier.
  void TakeStepsFrom(const RecordModel& other);
  /// The same for a set of one experiment, which is this one of the other's.
  void TakeStepsFrom(const RecordModel& other, int experiment);

  /// The records with these values, and with parameters of the cable or faults of the records set
  /// besides, one item of `also` after the other: those of an experiment side by side.
  std::vector<Simulated> SimulateWith(const Eigen::VectorXd& values,
                                      const std::vector<Unknowns::Setting>& also) const;

  /// From now on the runs that the experiment's correction comes from are twice as fine.
  /// @return false where they are as fine as is sensible already
  bool Sharpen(int experiment);

  /// Per experiment, what the corrected simulation may still be off by; as Refine found it.
  const Records& error() const { return error_; }

  /// Per experiment, one for samples that count and zero for those that a sensor did not measure.
  const Records& usable() const { return usable_; }
  /// From now on the experiment's record counts for nothing.
  void LeaveOut(int experiment) { usable_[static_cast<std::size_t>(experiment)].setZero(); }
  bool IsLeftOut(int experiment) const {
    return usable_[static_cast<std::size_t>(experiment)].isZero();
  }

  /// From now on the experiment is taken not to show the unknown.
  void Ignore(int unknown, int experiment) { ignored_.insert({unknown, experiment}); }

  Horizon WholeHorizon() const;
  /// The same part of every record and of what moves in it, but at least `samples` samples, and two
  /// periods where the start is unknown; quasi-static ones as a whole.
  Horizon PartialHorizon(double part, int samples) const;
  /// So many periods of the slowest swing of records whose start is unknown, and of the others as
  /// long; nothing where no start is unknown.
  std::optional<Horizon> Beginning(double periods) const;
  const Unknowns& unknowns() const { return unknowns_; }

  /// Asked for between steps, in any thread: true ends simulations, which have failed then.
  void SetStop(std::function<bool()> stop) { stop_ = std::move(stop); }
  bool Stopping() const { return stop_ && stop_(); }

  /// What has been simulated so far.
  SimulationCount count() const { return *count_; }
  /// The same of all models of this process, those that are gone included.
  static SimulationCount CountOfAll();

 private:
  struct SharedCount {
    std::atomic<long> simulations{0}, steps{0}, element_steps{0};
    operator SimulationCount() const { return {simulations, steps, element_steps}; }
    void Add(const SimulationCount& more) {
      simulations += more.simulations;
      steps += more.steps;
      element_steps += more.element_steps;
    }
  };
  static SharedCount& OfAll();
  using Points = std::vector<Eigen::VectorXd>;
  /// What steps do to a record, and how well that is known.
  struct StepsEffect {
    Eigen::MatrixXd correction;  ///< what is to be added
    Eigen::MatrixXd error;       ///< what may be left then
  };
  std::optional<StepsEffect> EffectOf(const Experiment& experiment, const Specimen& specimen,
                                      const SimulationOptions& options, int sharpness) const;
  bool Shows(int unknown, int experiment) const;
  bool LooksAlike(int experiment, const Eigen::VectorXd& p, const Eigen::VectorXd& q) const;
  /// The records at points that were simulated from the `first` of each experiment's on.
  std::vector<Simulated> Gather(const std::vector<Eigen::VectorXd>& points,
                                const std::vector<std::size_t>& first,
                                std::vector<std::vector<SimulatedRecord>>* raw) const;
  /// By experiment and point.
  std::vector<std::vector<SimulatedRecord>> Run(const std::vector<Points>& points,
                                                const Horizon& horizon) const;
  SimulationOptions OptionsOf(std::size_t experiment, double until) const;
  std::vector<SimulatedRecord> SimulateCounted(const Experiment& experiment,
                                               const std::vector<Specimen>& specimens,
                                               const SimulationOptions& options) const;
  /// Makes of what was simulated what the channels show, or says why it failed.
  void Complete(int experiment, const Eigen::VectorXd& values, SimulatedRecord* record) const;

  const Unknowns& unknowns_;
  std::function<bool()> stop_;
  std::unique_ptr<SharedCount> count_;      // counted in all threads
  std::vector<SimulationOptions> options_;  // by experiment
  std::vector<double> period_;              // by experiment with an unknown start [s], or 0
  std::vector<std::vector<double>>
      moved_;                   // by experiment and sample, the part of its motion so far
  std::vector<int> sharpness_;  // by experiment, of the runs behind the correction
  std::set<std::pair<int, int>> ignored_;
  Records usable_;
  Records correction_;  // what is added to the simulated records
  Records error_;
};

}  // namespace cosserat_cable
