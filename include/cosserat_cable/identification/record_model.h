// All records of a set simulated for given values of the unknowns, with derivatives.
#pragma once

#include <Eigen/Core>
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
  /// The same part of every record, but at least `samples` samples; quasi-static ones as a whole.
  Horizon PartialHorizon(double part, int samples) const;
  const Unknowns& unknowns() const { return unknowns_; }

 private:
  bool Shows(int unknown, int experiment) const;
  bool LooksAlike(int experiment, const Eigen::VectorXd& p, const Eigen::VectorXd& q) const;
  Simulated Assemble(const Eigen::VectorXd& values, const std::vector<SimulatedRecord>& raw) const;

  const Unknowns& unknowns_;
  std::vector<SimulationOptions> options_;  // by experiment
  std::set<std::pair<int, int>> ignored_;
  Records usable_;
  Records correction_;  // what is added to the simulated records
};

}  // namespace cosserat_cable
