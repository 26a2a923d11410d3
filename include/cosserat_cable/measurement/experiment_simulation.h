// An experiment simulated: what its channels would have shown with a given cable.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/measurement/measurement_set.h"
#include "cosserat_cable/measurement/specimen.h"

namespace cosserat_cable {

struct SimulationOptions {
  double dt = 5e-4;  ///< step [s]
  int elements = 40;
  double until = 1e300;  ///< no farther than this time [s] of the record
  /// Asked now and then, in any thread; true: the simulation ends, and has failed. May be empty.
  std::function<bool()> stop;
  /// The static equilibrium at the start of a cable like this one, at evenly spread nodes: from it
  /// this one's is found sooner, and where others lead nowhere. May be null.
  std::shared_ptr<const std::vector<Pose>> rest;
};

/// A row per sample of the experiment's record, a column per channel.
struct SimulatedRecord {
  bool ok = true;
  std::string message;  ///< why it failed, where it did
  Eigen::MatrixXd values;
};

/// Simulates the same experiment for several specimens side by side, in the lanes of the vector
/// units; what comes out for one does not depend on the others. Samples after `options.until` are
/// left out.
std::vector<SimulatedRecord> SimulateExperiment(const Experiment& experiment,
                                                const std::vector<Specimen>& specimens,
                                                const SimulationOptions& options);

/// The static equilibrium at the experiment's start, before anything pulls, twists or swings the
/// cable. `near`: as SimulationOptions::rest. Null: none was found.
std::shared_ptr<const std::vector<Pose>> FindRest(const Experiment& experiment,
                                                  const Specimen& specimen, int elements,
                                                  const std::vector<Pose>* near);

/// How far two simulations of an experiment are apart: the largest deviation of their difference
/// from its mean, in parts of the channel's range (a tenth of the widest range of its kind at
/// least), or the mean itself in parts of the cable's length (of the largest value, where it is not
/// a position); over the channels.
double RelativeDifference(const Experiment& experiment, double length,
                          const Eigen::MatrixXd& difference, const Eigen::MatrixXd& values);

/// An estimate free of the second-order errors of space and time, by Richardson's extrapolation
/// from a run with half the elements and twice the step.
struct RefinedRecord {
  SimulatedRecord record;
  /// RelativeDifference of the extrapolated record from the finer run: what that is wrong by.
  double discretisation = 0;
  /// Whether the two runs were near enough for an extrapolation; otherwise the record is the finer
  /// run's.
  bool extrapolated = false;
};

/// @pre options.elements is even, and 8 at least
RefinedRecord SimulateRefined(const Experiment& experiment, const Specimen& specimen,
                              const SimulationOptions& options);

/// The modes of small swings about the experiment's rest, displacements and rotations as a Swing
/// has them, for estimating an unknown start.
struct SwingShape {
  double w = 0;     ///< [rad/s]
  double zeta = 0;  ///< damping ratio
  std::vector<Eigen::Vector3d> displacement, rotation;
};
std::vector<SwingShape> FindSwingShapes(const Experiment& experiment, const Specimen& specimen,
                                        int elements, int count);

}  // namespace cosserat_cable
