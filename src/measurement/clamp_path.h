// Where an experiment's clamps are at a time, or at a step of a quasi-static one.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "base_motion.h"
#include "cosserat_cable/math/pose_curve.h"
#include "cosserat_cable/measurement/measurement_set.h"

namespace cosserat_cable {

/// One clamp. A free end has none: its pose is the identity and means nothing.
class ClampPath {
 public:
  /// `fault`: what the clamp does otherwise than the file or pose says.
  ClampPath(const EndCondition& end, const std::optional<ClampMotionFault>& fault);

  bool moves() const { return moving_; }
  /// At a time [s]: C2 between the samples, at rest before the first and after the last.
  const Motion& At(double t);
  /// At a step of a quasi-static experiment; after the last row that row's pose holds.
  Pose AtStep(int step) const;

 private:
  Motion Evaluated(double t);

  bool moving_ = false;
  // Of the last time that was asked for: rigs that are stepped together ask for the same.
  double last_time_ = std::numeric_limits<double>::quiet_NaN();
  Motion last_;
  Pose fixed_;
  std::vector<Pose> rows_;
  PoseCurve curve_;
  double shift_ = 0;  // advance of the motion [s]
  std::optional<Eigen::Quaterniond> tilt_;
  std::optional<BracketPath> bracket_;
};

/// The paths of one clamp in several specimens: those that move alike share one.
class SharedPaths {
 public:
  /// The end outlives the paths.
  explicit SharedPaths(const EndCondition& end) : end_(end) {}
  std::shared_ptr<ClampPath> With(const std::optional<ClampMotionFault>& fault);

 private:
  struct Known {
    std::optional<ClampMotionFault> fault;
    std::shared_ptr<ClampPath> path;
  };
  const EndCondition& end_;
  std::vector<Known> known_;
};

}  // namespace cosserat_cable
