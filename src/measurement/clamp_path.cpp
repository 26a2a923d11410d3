#include "clamp_path.h"

#include <algorithm>
#include <limits>

namespace cosserat_cable {

ClampPath::ClampPath(const EndCondition& end)
    : fixed_(end.pose), curve_(std::numeric_limits<double>::infinity()) {
  if (end.kind != EndCondition::Kind::kClamp || !end.motion) return;
  moving_ = true;
  rows_ = end.motion->poses;
  if (end.motion->quasi_static) return;
  for (std::size_t i = 0; i < rows_.size(); ++i) curve_.Append(end.motion->t[i], rows_[i]);
  curve_.Finish();
}

Motion ClampPath::At(double t) { return moving_ ? curve_.Follow(t) : Motion::Resting(fixed_); }

Pose ClampPath::AtStep(int step) const {
  if (!moving_) return fixed_;
  return rows_[std::min<std::size_t>(step, rows_.size() - 1)];
}

}  // namespace cosserat_cable
