#include "clamp_path.h"

#include <algorithm>
#include <limits>

#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {
namespace {

bool MoveAlike(const std::optional<ClampMotionFault>& one,
               const std::optional<ClampMotionFault>& other) {
  if (!one || !other) return !one && !other;
  return one->amplitude == other->amplitude && one->phase == other->phase &&
         one->bracket_frequency == other->bracket_frequency &&
         one->bracket_damping == other->bracket_damping && one->tilt == other->tilt;
}

}  // namespace

ClampPath::ClampPath(const EndCondition& end, const std::optional<ClampMotionFault>& fault)
    : fixed_(end.pose), curve_(std::numeric_limits<double>::infinity()) {
  if (end.kind != EndCondition::Kind::kClamp) return;
  if (fault && !fault->tilt.isZero(0)) {
    tilt_ = RotationExp(fault->tilt);
    fixed_.q = (fixed_.q * *tilt_).normalized();
  }
  if (!end.motion) return;
  moving_ = true;
  const ClampMotion& motion = *end.motion;
  rows_ = fault && fault->amplitude != 1 ? Amplified(motion, fault->amplitude) : motion.poses;
  if (motion.quasi_static) return;
  for (std::size_t i = 0; i < rows_.size(); ++i) curve_.Append(motion.t[i], rows_[i]);
  curve_.Finish();
  if (!fault) return;
  if (fault->phase != 0)
    if (const double w = DominantFrequency(motion); w > 0) shift_ = fault->phase / w;
  if (fault->has_bracket() && motion.t.size() > 1) {
    ClampMotion amplified = motion;
    amplified.poses = rows_;
    const double begin = motion.t.front(), end_time = motion.t.back();
    const double sample = (end_time - begin) / static_cast<double>(motion.t.size() - 1);
    bracket_.emplace(curve_, shift_, MeanPose(amplified), sample, begin, end_time, *fault);
  }
}

const Motion& ClampPath::At(double t) {
  if (t != last_time_) last_ = Evaluated(t);
  last_time_ = t;
  return last_;
}

Motion ClampPath::Evaluated(double t) {
  if (!moving_) return Motion::Resting(fixed_);
  const Motion motion = bracket_ ? bracket_->At(t) : curve_.Follow(t + shift_);
  return tilt_ ? motion * Pose{Eigen::Vector3d::Zero(), *tilt_} : motion;
}

Pose ClampPath::AtStep(int step) const {
  if (!moving_) return fixed_;
  Pose pose = rows_[std::min<std::size_t>(static_cast<std::size_t>(step), rows_.size() - 1)];
  if (tilt_) pose.q = (pose.q * *tilt_).normalized();
  return pose;
}

std::shared_ptr<ClampPath> SharedPaths::With(const std::optional<ClampMotionFault>& fault) {
  for (const Known& one : known_)
    if (MoveAlike(one.fault, fault)) return one.path;
  Known& one = known_.emplace_back();
  one.fault = fault;
  one.path = std::make_shared<ClampPath>(end_, fault);
  return one.path;
}

}  // namespace cosserat_cable
