#include "cosserat_cable/contact/tracker.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// A straight way through a wall is exactly as long as both distances: rounding must not decide [m].
constexpr double kRounding = 1e-9;

}  // namespace

TrackedClearance ContactTracker::Look(const Body& body, const Eigen::Vector3d& p_B, double radius,
                                      double margin, double reach) const {
  TrackedClearance seen;
  const double way = known_ ? (p_B - p_B_).norm() : 0;
  if (known_ && distance_ - way > radius + margin) {
    seen.distance = distance_ - way;
    return seen;
  }
  const double box_distance = body.LowerBound(p_B);
  if (box_distance > radius + margin) {
    seen.distance = box_distance;
    return seen;
  }
  // The nearest surface is where the last one was, or nearer: the search ends there.
  const Clearance direct = body.Query(p_B, std::min(reach, at_most_ + way + kRounding));
  if (direct.shape < 0) {
    seen.distance = std::max(reach, box_distance);
    return seen;
  }

  const bool inside = direct.distance < 0;
  const bool near_side = has_side_ && !direct.rim && direct.distance <= radius;
  const bool turned = direct.normal.dot(normal_) < 0;
  const bool may_have_crossed = distance_ < 0 || way + kRounding >= distance_ + direct.distance;
  if (near_side && (inside || (turned && may_have_crossed))) {
    TrackedClearance proxied = LookFromProxy(body, p_B, radius, reach);
    proxied.crossed = turned;
    proxied.at_most = std::abs(direct.distance);
    // Farther off, the point would not be touching on that side: the memory no longer applies.
    if (proxied.distance <= radius) return proxied;
  }
  seen.distance = direct.distance;
  seen.nearest = direct.nearest;
  seen.normal = direct.normal;
  seen.at_most = std::abs(direct.distance);
  seen.exact = true;
  return seen;
}

TrackedClearance ContactTracker::LookFromProxy(const Body& body, const Eigen::Vector3d& p_B,
                                               double radius, double reach) const {
  TrackedClearance seen;
  seen.exact = true;
  const double height = (p_B - nearest_).dot(normal_);
  const Clearance proxy = body.Query(p_B + (radius - height) * normal_, reach);
  const bool on_our_side = proxy.shape >= 0 && proxy.distance >= 0 && proxy.normal.dot(normal_) > 0;
  if (on_our_side) {
    seen.distance = (p_B - proxy.nearest).dot(proxy.normal);
    seen.nearest = proxy.nearest;
    seen.normal = proxy.normal;
  } else {
    seen.distance = height;
    seen.nearest = p_B - height * normal_;
    seen.normal = normal_;
  }
  return seen;
}

void ContactTracker::Accept(const Eigen::Vector3d& p_B, const TrackedClearance& seen) {
  const bool from_memory =
      known_ && !seen.exact && distance_ - (p_B - p_B_).norm() >= seen.distance;
  if (from_memory) return;
  known_ = true;
  has_side_ = seen.exact;
  distance_ = seen.distance;
  at_most_ = seen.at_most;
  p_B_ = p_B;
  nearest_ = seen.nearest;
  normal_ = seen.normal;
}

}  // namespace cosserat_cable
