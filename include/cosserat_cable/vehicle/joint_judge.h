// Judges the recorded positions of one joint against its URDF: limits of position and velocity,
// degrees and millimetres, turns too fast for their samples, and poses that the joint cannot take.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "cosserat_cable/vehicle/finding.h"
#include "cosserat_cable/vehicle/vehicle_model.h"

namespace cosserat_cable {

/// A joint's position as a transform of its child says it.
struct JointReading {
  double position = 0;                ///< [rad] within half a turn of zero, or [m]
  double off_axis = 0, off_turn = 0;  ///< what the joint does not explain [m], [rad]
};
/// @pre `joint` is revolute or prismatic
JointReading ReadJoint(const JointModel& joint, const Pose& X_PC);

class JointJudge {
 public:
  /// `joint` outlives this. `max_gap` [s]: no velocity is taken across longer intervals.
  JointJudge(const JointModel& joint, double max_gap);

  /// The next position, as a joint state says it. @pre stamps [ns] increase
  void Add(std::int64_t stamp, double position);
  /// The same from a transform.
  void Add(std::int64_t stamp, const Pose& X_PC);
  /// Time starts anew; what was found stays.
  void Restart();

  /// What was found so far; `topic`: where the positions were recorded.
  Findings Report(const std::string& topic) const;

 private:
  struct Worst {
    std::uint64_t count = 0;
    std::int64_t first = 0, worst = 0;  // stamps [ns]
    double size = 0, value = 0;
    void Add(std::int64_t stamp, double new_size, double new_value);
  };

  void Judge(std::int64_t stamp, double position, bool wraps);
  Finding Start(const char* kind, const std::string& topic, const Worst& worst) const;
  void ReportLimit(const std::string& topic, Findings* findings) const;
  void ReportVelocity(const std::string& topic, Findings* findings) const;
  bool turns() const { return joint_->type == JointModel::Type::kRevolute; }
  const char* unit() const { return turns() ? "rad" : "m"; }

  const JointModel* joint_;
  double max_gap_, tolerance_;
  double least_ = std::numeric_limits<double>::infinity(), most_ = -least_;

  bool has_last_ = false;
  std::int64_t last_ = 0, base_ = 0;  // stamps of the sample before, and of where velocity begins
  double last_position_ = 0, base_travel_ = 0, travel_ = 0;

  std::uint64_t samples_ = 0, velocities_ = 0;  // that were judged
  Worst limit_, velocity_, half_turn_, off_axis_, off_turn_;
};

}  // namespace cosserat_cable
