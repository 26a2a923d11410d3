#include "upright_watch.h"

#include <cstdlib>
#include <optional>

#include "cosserat_cable/input/gravity.h"

namespace cosserat_cable {
namespace {

constexpr std::int64_t kLookInterval = 20'000'000;  // [ns]

}  // namespace

UprightWatch::UprightWatch(const Eigen::Vector3d& gravity_W, const std::string& root)
    : root_(root),
      nothing_seen_(gravity_W == kGravityDown ? gravity_W : Eigen::Vector3d::Zero()),
      judge_(nothing_seen_) {}

void UprightWatch::Look(const LinkMotion& links) {
  if (std::abs(links.last_stamp() - looked_) < kLookInterval) return;
  looked_ = links.last_stamp();
  // Before the first transform above it is known, the vehicle itself is the world.
  if (links.world() != world_) judge_ = nothing_seen_;
  world_ = links.world();
  if (const std::optional<Pose> X_WR = links.LatestPose(world_, root_))
    judge_.Add(links.last_stamp(), X_WR->q);
}

}  // namespace cosserat_cable
