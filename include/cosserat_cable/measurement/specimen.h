// What hangs in a rig: the set's cable with what is special to an experiment, and with the values
// that a cable file or a fit gives it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// How an experiment with an unknown start begins: out of its static equilibrium by a sum of
/// shapes. A value per node; nodes are spread evenly whatever their number.
struct Swing {
  std::vector<Eigen::Vector3d> displacement, rotation;      ///< [m] world, [rad] section frame
  std::vector<Eigen::Vector3d> velocity, angular_velocity;  ///< [m/s] world, [rad/s] section frame
};

/// One specimen as a simulation needs it. Every number is known.
struct Specimen {
  CableModel cable;
  double disc_inertia = 0;  ///< [kg m^2], of experiments with a disc
  /// Rotation vector [rad], in clamp a's frame, by which the clamp points elsewhere than the set
  /// says; the whole rest of the rig stays.
  Eigen::Vector3d tilt_a = Eigen::Vector3d::Zero();
  Swing swing;    ///< of an experiment with an unknown start; empty: at rest
  Faults faults;  ///< of the record and its rig
};

/// The keys of an experiment's cable: the specimen's own before the set's. Its faults are the
/// experiment's, where it has some, else the set's.
CableKeys SpecimenKeys(const MeasurementSet& set, const Experiment& experiment);

/// The same, with the fitted quantities of a cable file: stiffness, damping and extensions come
/// from the file where it gives them; length, diameter, masses from the set.
CableKeys SpecimenKeys(const MeasurementSet& set, const Experiment& experiment,
                       const CableKeys& cable_file);

/// The keys with zero for damping that the set says to be unknown: for experiments in which nothing
/// moves in time.
CableKeys WithoutUnknownDamping(CableKeys keys);

/// The specimen that these keys describe. Missing and unknown values are problems.
Specimen MakeSpecimen(const CableKeys& keys, const Experiment& experiment, Problems* problems);

}  // namespace cosserat_cable
