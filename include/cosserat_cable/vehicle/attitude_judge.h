// Whether a vehicle's body tips and turns as no body does: angles in degrees that were taken for
// radians.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "cosserat_cable/vehicle/finding.h"

namespace cosserat_cable {

class AttitudeJudge {
 public:
  /// `max_gap` [s]: no velocity is taken across longer intervals.
  explicit AttitudeJudge(double max_gap) : max_gap_(max_gap) {}

  /// The orientation of an edge's child in its parent. @pre stamps [ns] increase
  void Add(std::int64_t stamp, const Eigen::Quaterniond& q_PC);
  /// Time starts anew; what was found stays.
  void Restart() { has_last_ = false; }

  /// What was found so far; `subject`, `topic`: of the findings.
  Findings Report(const std::string& subject, const std::string& topic) const;

 private:
  void AddTilt(std::int64_t stamp, double tilt);

  double max_gap_;
  bool has_last_ = false;
  std::int64_t last_ = 0;  // [ns]
  Eigen::Quaterniond q_last_ = Eigen::Quaterniond::Identity();

  std::uint64_t parts_ = 0, fast_ = 0;  // tenths of a second, and those that turn too fast
  double squared_tips_ = 0;             // of the z axis' velocity [rad^2/s^2]
  double fastest_ = 0;                  // [rad/s]
  std::int64_t fastest_at_ = 0;

  bool has_tilt_ = false, rises_ = true;
  double far_ = 0;  // tilt farthest from where it last turned round [rad]
  std::uint64_t swings_ = 0;
  std::int64_t first_swing_ = 0;
  double least_ = 0, most_ = 0;  // tilt of the z axis [rad]
};

}  // namespace cosserat_cable
