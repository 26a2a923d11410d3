// Whether a vehicle stands upright in a recording, or gravity pulls it out of its roof all the
// time: then an axis is meant otherwise.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "cosserat_cable/vehicle/finding.h"

namespace cosserat_cable {

class UprightJudge {
 public:
  /// Of the inertial frame [m/s^2]; 0: nothing is judged.
  explicit UprightJudge(const Eigen::Vector3d& gravity_W) : gravity_W_(gravity_W) {}

  /// The orientation of the vehicle's root.
  void Add(std::int64_t stamp, const Eigen::Quaterniond& q_WR);
  /// What was found: nothing where the vehicle stood upright at any time.
  Findings Report(const std::string& root, const std::string& world) const;

 private:
  Eigen::Vector3d gravity_W_;
  std::uint64_t count_ = 0;
  std::int64_t first_ = 0;
  double least_ = 0, most_ = 0;  // of the roof from up [rad]
};

}  // namespace cosserat_cable
