#include "cosserat_cable/vehicle/publisher_judge.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// Between samples farther apart than this an edge may do anything [ns].
constexpr std::int64_t kTogether = 500'000'000;
// What two sources of one value differ by at most: rounding to float or to a millimetre [m], [rad].
constexpr double kSameTranslation = 1e-3, kSameRotation = 2e-3;
// What a motion bends away from the straight line between two samples, in the step between them.
constexpr double kBend = 0.5;
// The faster publisher is interpolated: its samples say what happened between the other's.
constexpr double kFaster = 1.5;

double Angle(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::Quaterniond turn = from.conjugate() * to;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

}  // namespace

void PublisherJudge::Add(int publisher, std::int64_t stamp, const Pose& X_PC) {
  auto same = std::find_if(publishers_.begin(), publishers_.end(),
                           [&](const Publisher& known) { return known.number == publisher; });
  if (same == publishers_.end()) {
    publishers_.emplace_back();
    same = publishers_.end() - 1;
    same->number = publisher;
  } else if (stamp <= same->last.stamp) {
    return;
  }
  same->before = same->last;
  same->last = {stamp, X_PC};
  if (publishers_.size() == 1) return;
  for (const Publisher& other : publishers_) {
    if (other.number == publisher) continue;
    Compare(other, *same);
    Compare(*same, other);
  }
}

// The last sample of `slow` with the motion of `fast` at that time.
void PublisherJudge::Compare(const Publisher& fast, const Publisher& slow) {
  const std::int64_t interval = fast.last.stamp - fast.before.stamp;
  const std::int64_t longer = slow.last.stamp - slow.before.stamp;
  const bool known = fast.before.stamp > 0 && slow.before.stamp > 0 && interval <= kTogether &&
                     static_cast<double>(interval) <= kFaster * static_cast<double>(longer);
  const Sample& sample = slow.last;
  if (!known || sample.stamp < fast.before.stamp || sample.stamp > fast.last.stamp) return;
  const double part =
      static_cast<double>(sample.stamp - fast.before.stamp) / static_cast<double>(interval);
  const Eigen::Vector3d p = fast.before.X.p + part * (fast.last.X.p - fast.before.X.p);
  const Eigen::Quaterniond q = fast.before.X.q.slerp(part, fast.last.X.q);
  const double translation = (sample.X.p - p).norm();
  const double rotation = Angle(q, sample.X.q);
  const double step = (fast.last.X.p - fast.before.X.p).norm();
  const double turn = Angle(fast.before.X.q, fast.last.X.q);
  if (translation <= kSameTranslation + kBend * step && rotation <= kSameRotation + kBend * turn)
    return;
  if (conflict_.count == 0) conflict_.first = sample.stamp;
  // A radian at half a metre weighs as much as half a metre.
  constexpr double kLever = 0.5;
  if (translation + kLever * rotation > conflict_.translation + kLever * conflict_.rotation) {
    conflict_.worst = sample.stamp;
    conflict_.translation = translation;
    conflict_.rotation = rotation;
    conflict_.one = std::min(fast.number, slow.number);
    conflict_.other = std::max(fast.number, slow.number);
  }
  ++conflict_.count;
}

}  // namespace cosserat_cable
