// A measurement set: what was clamped where, how the clamps moved, how the motion was started and
// what was recorded. A folder with measurement.yaml and the CSV files that it names, version 1.
//
// SI units; the world frame W is inertial.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/input/problems.h"
#include "cosserat_cable/math/pose.h"

namespace cosserat_cable {

enum class ClampSide { kA, kB };

/// Position [m], velocity [m/s], acceleration [m/s^2] of a point; angle [rad], the integral of the
/// twist from clamp a, and its rate [rad/s]; force [N] and moment [N m] by a clamp on the cable.
enum class Quantity { kPosition, kVelocity, kAcceleration, kAngle, kRate, kForce, kMoment };

/// "position", "velocity", ... as a set writes it.
const char* ToString(Quantity quantity);

/// One column of a record.
struct Channel {
  std::string column;
  Quantity quantity = Quantity::kPosition;
  double s = 0;                     ///< arc length [m]; not of forces and moments
  ClampSide clamp = ClampSide::kA;  ///< of forces and moments
  int axis = 0;                     ///< 0, 1, 2: x, y, z; not of angles and rates
  bool in_frame_a = false;          ///< components in clamp a's moving frame, else the world's
  std::optional<double> sigma;      ///< standard deviation of the noise, where it is known
  bool unknown_offset = false;      ///< a constant is to be estimated with it
  SourceMark mark;
};

/// What was measured: a row per sample. Also a motion file's and a load's first column.
struct Record {
  std::string file;           ///< as the set names it
  bool quasi_static = false;  ///< the first column is `step`: one equilibrium per row, in order
  std::vector<double> t;      ///< [s], increasing; the steps 0, 1, ... of a quasi-static one;
                              ///< sample i stands on line i + 2 of the file
  Eigen::MatrixXd values;     ///< a column per channel, in the order of the channels
};

/// Of times [s], from one to the next. @pre there are two at least
double MedianInterval(const std::vector<double>& t);

/// How a clamp moves: samples of its pose X_WC.
struct ClampMotion {
  std::string file;
  bool quasi_static = false;
  std::vector<double> t;  ///< as of a record
  std::vector<Pose> poses;
};

/// A rigid body at end b, free to move.
struct Disc {
  double inertia = 0;   ///< about the cable's axis [kg m^2]; half of it across
  double mass = 0;      ///< [kg]
  bool guided = false;  ///< may only turn about and slide along the axis
};

/// How an end is held.
struct EndCondition {
  enum class Kind { kFree, kClamp, kDisc };
  Kind kind = Kind::kClamp;
  Pose pose;                          ///< X_WC of a clamp that does not move
  std::optional<ClampMotion> motion;  ///< of one that does
  /// Components in the clamp's own frame that it does not hold: along and about its axes.
  std::array<bool, 3> translation_free{}, rotation_free{};
  /// Its rotation about a3 was not measured, and no moment about a3 acts there.
  bool roll_unknown = false;
  Disc disc;
  SourceMark mark;
};

struct PointAt {
  double s = 0;  ///< arc length [m]
  Eigen::Vector3d position_W = Eigen::Vector3d::Zero();
};

/// The state at the first time of the motion files, or of the record where no clamp moves.
struct StartCondition {
  enum class Kind {
    kRest,     ///< static equilibrium, moving along rigidly with clamp a
    kHeld,     ///< pulled there by a force, from rest; let go at the first time
    kTwisted,  ///< the disc held at an angle [rad], let go
    kUnknown   ///< already swinging: to be estimated
  };
  Kind kind = Kind::kRest;
  std::optional<PointAt> near;  ///< kRest: which of several equilibria
  PointAt held;                 ///< kHeld
  double twisted = 0;           ///< kTwisted [rad]
  SourceMark mark;
};

/// Known forces on the cable, world frame.
struct ExperimentLoad {
  /// One sample of a force at one point; constant loads have one sample each.
  struct Sample {
    double t = 0;  ///< [s], or the step
    double s = 0;  ///< arc length [m]
    Eigen::Vector3d force_W = Eigen::Vector3d::Zero();
  };
  std::string file;  ///< empty: given in the set itself, and constant
  bool quasi_static = false;
  /// Constant: all act. From a file: by t that does not decrease; samples of one t are forces at
  /// different points.
  std::vector<Sample> samples;
};

struct Experiment {
  std::string name;
  std::string kind;    ///< a label for people; may be empty
  CableKeys specimen;  ///< what is given here goes before the set's cable; its faults likewise
  Eigen::Vector3d gravity_W{0, 0, -9.81};
  EndCondition a, b;
  StartCondition start;
  ExperimentLoad load;
  std::vector<Channel> channels;
  Record record;
  SourceMark mark;

  /// One equilibrium after the other instead of motion.
  bool quasi_static() const { return record.quasi_static; }
  /// Where the simulation starts [s]: the first time of the motion files, else of the record.
  double start_time() const;
};

struct MeasurementSet {
  std::string file;  ///< that it was read from
  std::string folder;
  CableKeys cable;  ///< and the faults of all experiments that do not give their own
  SourceMark cable_mark;
  std::vector<Experiment> experiments;
};

/// Reads FOLDER/measurement.yaml (or the file itself, where the path names one) and all files that
/// it names. Every mistake goes to `problems` with file, line and key: unknown and missing keys,
/// wrong types, numbers that are not finite or out of range, times that do not increase, columns
/// that are not there or that no channel names. Where `problems` grew, the result is not to be
/// used.
MeasurementSet LoadMeasurementSet(const std::string& path, Problems* problems);

/// All files that were read: the set's own, records, motions, loads.
std::vector<std::string> FilesOf(const MeasurementSet& set);

/// What does not look like a measurement although it can be read, said so that a user understands
/// it: frozen or clipped samples, gaps, positions farther from clamp a than the cable is long
/// (a slip of units), a record shorter than a few samples. Warnings carry the file and line.
void CheckPlausibility(const MeasurementSet& set, Problems* problems, Problems* warnings);

/// Writes the set to a folder, which is made where it is not there: measurement.yaml and its CSVs,
/// numbers in full precision. It reads back to the same set. Files without a name are named after
/// their experiment.
/// @throws std::runtime_error where a file cannot be written whole, lies outside the folder, or
/// would have to hold two different contents
void WriteMeasurementSet(const MeasurementSet& set, const std::string& folder);

}  // namespace cosserat_cable
