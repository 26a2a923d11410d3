// Whether a vehicle stands upright in a recording, or gravity pulls it out of its side or roof for
// most of the time: then an axis or a unit is meant otherwise.
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

  /// The orientation of the vehicle's root, at even times.
  void Add(std::int64_t stamp, const Eigen::Quaterniond& q_WR);
  /// What was found: nothing where the vehicle stood upright for most of the time, or again and
  /// again.
  Findings Report(const std::string& root, const std::string& world) const;

 private:
  /// A time in which it lies.
  struct Run {
    std::int64_t first = 0, last = 0;  // stamps [ns]
    std::uint64_t count = 0;
    double least = 0, most = 0;  // of the roof from up [rad]
  };

  Eigen::Vector3d gravity_W_;
  std::uint64_t count_ = 0;
  std::int64_t first_ = 0, last_ = 0;
  Run run_, longest_;
};

}  // namespace cosserat_cable
