#include "cosserat_cable/vehicle/upright_judge.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// Vehicles stand on steep slopes, and roll over; none lies on its side from beginning to end.
constexpr double kLies = 60 * M_PI / 180;
constexpr double kUpsideDown = 120 * M_PI / 180;
constexpr std::uint64_t kFewest = 3;

}  // namespace

void UprightJudge::Add(std::int64_t stamp, const Eigen::Quaterniond& q_WR) {
  if (gravity_W_.norm() == 0) return;
  const Eigen::Vector3d roof = q_WR * Eigen::Vector3d::UnitZ(), up = -gravity_W_;
  const double angle = std::atan2(up.cross(roof).norm(), up.dot(roof));
  if (count_++ == 0) {
    first_ = stamp;
    least_ = most_ = angle;
  }
  least_ = std::min(least_, angle);
  most_ = std::max(most_, angle);
}

Findings UprightJudge::Report(const std::string& root, const std::string& world) const {
  if (count_ < kFewest || least_ < kLies) return {};
  const bool upside_down = least_ > kUpsideDown;
  Finding finding;
  finding.kind = upside_down ? "upside_down" : "on_its_side";
  finding.subject = "the vehicle";
  finding.what = std::string(upside_down ? "hangs upside down" : "lies on its side") +
                 " in all of the recording: the z axis of '" + root + "' is " +
                 Printed("%.0f", least_ * 180 / M_PI) + " to " +
                 Printed("%.0f deg", most_ * 180 / M_PI) +
                 " from up, so that gravity points out of its " + (upside_down ? "roof" : "side");
  finding.remedy = "does the z axis of '" + world +
                   "' point down? --gravity 0,0,9.81 (~gravity of the node) then; or do axes of '" +
                   root + "' follow another convention than x forward, z up? turn its transform";
  finding.count = count_;
  finding.first = finding.worst = first_;
  finding.size = most_;
  finding.limit = kLies;
  finding.unit = "rad";
  return {finding};
}

}  // namespace cosserat_cable
