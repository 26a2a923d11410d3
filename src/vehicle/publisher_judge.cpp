#include "cosserat_cable/vehicle/publisher_judge.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// Samples farther apart in time are not compared [ns].
constexpr std::int64_t kTogether = 500'000'000;
// What two sources of the same value differ by at most: rounding to float, to a millimetre [m],
// [rad].
constexpr double kSameTranslation = 1e-3, kSameRotation = 2e-3;
// What an edge moves in a time, at most, times what it moved in the same time just before.
constexpr double kFaster = 3;

double Angle(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::Quaterniond turn = from.conjugate() * to;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

}  // namespace

void PublisherJudge::Add(int publisher, std::int64_t stamp, const Pose& X_PC) {
  Publisher* same = nullptr;
  for (Publisher& known : publishers_) {
    if (known.number == publisher)
      same = &known;
    else
      Compare(known, publisher, stamp, X_PC);
  }
  if (!same) {
    publishers_.emplace_back();
    same = &publishers_.back();
    same->number = publisher;
  } else if (publishers_.size() > 1 && stamp > same->stamp) {
    same->interval = stamp - same->stamp;
    same->step = (X_PC.p - same->X.p).norm();
    same->turn = Angle(same->X.q, X_PC.q);
  }
  same->stamp = stamp;
  same->X = X_PC;
}

void PublisherJudge::Compare(const Publisher& known, int publisher, std::int64_t stamp,
                             const Pose& X_PC) {
  const std::int64_t apart = std::abs(stamp - known.stamp);
  if (known.interval == 0 || apart > kTogether) return;
  const double intervals =
      kFaster * std::max(1.0, static_cast<double>(apart) / static_cast<double>(known.interval));
  const double translation = (X_PC.p - known.X.p).norm();
  const double rotation = Angle(known.X.q, X_PC.q);
  // Of messages with the same stamp nothing has moved.
  const double moved = apart == 0 ? 0 : intervals;
  if (translation <= kSameTranslation + moved * known.step &&
      rotation <= kSameRotation + moved * known.turn) {
    return;
  }
  if (conflict_.count == 0) conflict_.first = stamp;
  // A radian at half a metre weighs as much as half a metre.
  constexpr double kLever = 0.5;
  if (translation + kLever * rotation > conflict_.translation + kLever * conflict_.rotation) {
    conflict_.worst = stamp;
    conflict_.translation = translation;
    conflict_.rotation = rotation;
    conflict_.one = known.number;
    conflict_.other = publisher;
  }
  ++conflict_.count;
}

}  // namespace cosserat_cable
