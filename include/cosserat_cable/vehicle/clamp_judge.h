// How a cable's clamps move to one another over a whole recording: how far apart they come, and how
// far they turn.
#pragma once

#include <cstdint>
#include <string>

#include "cosserat_cable/math/pose.h"
#include "cosserat_cable/vehicle/finding.h"

namespace cosserat_cable {

class ClampJudge {
 public:
  struct Range {
    bool known = false;
    double first = 0, least = 0, most = 0;  ///< distance between the clamps [m]
    std::int64_t most_at = 0;               ///< stamp [ns]
    double turn = 0;                        ///< largest, from how they first were [rad]
    std::int64_t turn_at = 0;               ///< stamp [ns]
  };

  /// `length`, `diameter`: of the cable [m].
  ClampJudge(std::string cable, double length, double diameter)
      : cable_(std::move(cable)), length_(length), diameter_(diameter) {}

  /// Poses of the clamps in one frame, at increasing stamps [ns], less than half a turn apart.
  void Add(std::int64_t stamp, const Pose& X_WA, const Pose& X_WB);
  /// The cable was clamped anew: turns are counted from here.
  void Restart() { has_start_ = false; }

  const Range& range() const { return range_; }
  /// "350.0 to 420.0 mm apart (88 to 105 % of its length, most at 11.000 s)".
  std::string Describe() const;
  Findings Report() const;

 private:
  double MostTurn() const;

  std::string cable_;
  double length_, diameter_;
  Range range_;
  std::uint64_t too_far_ = 0, too_turned_ = 0;
  std::int64_t first_too_far_ = 0, first_too_turned_ = 0;
  bool has_start_ = false;
  Eigen::Quaterniond start_;                       // R_AB
  Eigen::Vector3d phi_ = Eigen::Vector3d::Zero();  // from there [rad], over whole turns
};

}  // namespace cosserat_cable
