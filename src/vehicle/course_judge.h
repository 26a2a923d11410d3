// How fast one edge goes, over times in which jitter and noise even out: speeds and accelerations
// that no vehicle has show a wrong unit.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "cosserat_cable/vehicle/finding.h"

namespace cosserat_cable {

/// Beyond any vehicle.
struct CourseLimits {
  double speed;         ///< [m/s]
  double acceleration;  ///< [m/s^2]
};

class CourseJudge {
 public:
  CourseJudge(const CourseLimits& limits, double max_gap) : limits_(limits), max_gap_(max_gap) {}

  /// @pre stamps [ns] increase
  void Add(std::int64_t stamp, const Eigen::Vector3d& p);
  void Restart();
  /// Nothing where it happened too seldom to be a unit: single samples are told otherwise.
  void Report(Findings* findings) const;

 private:
  CourseLimits limits_;
  double max_gap_;
  struct Place {
    std::int64_t stamp = 0;
    Eigen::Vector3d p = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();
  };
  Place last_;
  int known_ = 0;  // places and velocities in a row
  std::uint64_t parts_ = 0, beyond_ = 0;
  std::int64_t first_ = 0, worst_ = 0;
  double fastest_ = 0, hardest_ = 0;
};

}  // namespace cosserat_cable
