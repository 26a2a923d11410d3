// All records of a set simulated for given values of the unknowns, with derivatives.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cosserat_cable/identification/unknowns.h"

namespace cosserat_cable {

/// Per experiment: a row per sample, a column per channel.
using Records = std::vector<Eigen::MatrixXd>;

/// How far into the records: per experiment, the last time that counts [s].
using Horizon = std::vector<double>;

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

  struct Derivatives {
    Simulated at;
    /// By unknown, then by experiment: derivative of the records by value/scale. Empty where the
    /// unknown does not concern the experiment.
    std::vector<Records> by_unknown;
  };
  enum class Difference { kForward, kCentral };
  Derivatives Differentiate(const Eigen::VectorXd& values, const Horizon& horizon,
                            Difference difference) const;

  /// Finds at these values what the steps in space and time make of the records, by comparing with
  /// finer runs, and corrects all further simulations by it. Experiments for which they are too far
  /// apart are simulated more finely from then on.
  /// @return the largest correction, in parts of its channel's range
  double Refine(const Eigen::VectorXd& values);

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

 private:
  bool Shows(int unknown, int experiment) const;
  bool LooksAlike(int experiment, const Eigen::VectorXd& p, const Eigen::VectorXd& q) const;
  Simulated Assemble(const Eigen::VectorXd& values, const std::vector<SimulatedRecord>& raw) const;

  const Unknowns& unknowns_;
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
