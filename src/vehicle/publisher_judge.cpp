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

// Two courses are farther apart than this [m], with half a metre for a radian; nearer ones are
// noise.
constexpr double kApart = 5e-3, kLever = 0.5;
// Every other sample continues the same course: next to it the neighbours are off by more than
// this.
constexpr double kContinues = 0.2;
constexpr std::uint64_t kFewestInARow = 8;
// What turns by more from sample to sample may be a wheel: no courses can be told [rad].
constexpr double kLargestTurn = 1.0;

double Angle(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::Quaterniond turn = from.conjugate() * to;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

struct Apart {
  double translation, rotation;
  double whole() const { return translation + kLever * rotation; }
};

Apart Distance(const Pose& a, const Pose& b) { return {(a.p - b.p).norm(), Angle(a.q, b.q)}; }

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
  LookForTwoCourses(&*same);
  if (publishers_.size() == 1) return;
  for (Publisher& other : publishers_) {
    if (other.number == publisher) continue;
    Compare(other, &*same);
    Compare(*same, &other);
  }
}

void PublisherJudge::LookForTwoCourses(Publisher* publisher) {
  std::array<Sample, 5>& recent = publisher->recent;
  recent[publisher->count++ % recent.size()] = publisher->last;
  const Apart step = Distance(publisher->before.X, publisher->last.X);
  const bool spins = step.translation < kApart && step.rotation > kLargestTurn;
  if (publisher->before.stamp == 0 || step.whole() < kApart || spins) {
    publisher->to_and_fro = 0;
    return;
  }
  if (publisher->count < recent.size()) return;
  const auto ago = [&](std::uint64_t n) -> const Sample& {
    return recent[(publisher->count - 1 - n) % recent.size()];
  };
  const Sample& middle = ago(2);
  // How far it is off the straight line between two others.
  const auto off = [&](const Sample& from, const Sample& to) {
    const double part =
        static_cast<double>(middle.stamp - from.stamp) / static_cast<double>(to.stamp - from.stamp);
    return Distance({from.X.p + part * (to.X.p - from.X.p), from.X.q.slerp(part, to.X.q)},
                    middle.X);
  };
  const Apart neighbours = off(ago(3), ago(1)), next = off(ago(4), ago(0));
  if (ago(0).stamp - ago(4).stamp > kTogether || neighbours.whole() < kApart ||
      next.whole() > kContinues * neighbours.whole()) {
    publisher->to_and_fro = 0;
    return;
  }
  if (++publisher->to_and_fro < kFewestInARow) return;
  Conflict& found = two_courses_;
  if (found.count == 0) found.first = middle.stamp;
  found.count += publisher->to_and_fro == kFewestInARow ? kFewestInARow : 1;
  if (neighbours.whole() > found.translation + kLever * found.rotation) {
    found.worst = middle.stamp;
    found.translation = neighbours.translation;
    found.rotation = neighbours.rotation;
    found.one = found.other = publisher->number;
  }
}

// The last sample of `slow` with the motion of `fast` at that time.
void PublisherJudge::Compare(const Publisher& fast, Publisher* slow) {
  const std::int64_t interval = fast.last.stamp - fast.before.stamp;
  const std::int64_t longer = slow->last.stamp - slow->before.stamp;
  const bool known = fast.before.stamp > 0 && slow->before.stamp > 0 && interval <= kTogether &&
                     static_cast<double>(interval) <= kFaster * static_cast<double>(longer);
  const Sample& sample = slow->last;
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
  if (translation + kLever * rotation > conflict_.translation + kLever * conflict_.rotation) {
    conflict_.worst = sample.stamp;
    conflict_.translation = translation;
    conflict_.rotation = rotation;
    conflict_.one = std::min(fast.number, slow->number);
    conflict_.other = std::max(fast.number, slow->number);
  }
  // Several publishers may be compared with one sample.
  if (slow->differed != sample.stamp) ++conflict_.count;
  slow->differed = sample.stamp;
}

}  // namespace cosserat_cable
