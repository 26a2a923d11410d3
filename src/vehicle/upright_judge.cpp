#include "cosserat_cable/vehicle/upright_judge.h"

#include <algorithm>
#include <cmath>

namespace cosserat_cable {
namespace {

// Vehicles stand on steep slopes, and roll over; none lies on its side for most of a recording.
constexpr double kLies = 60 * M_PI / 180;
constexpr double kUpsideDown = 120 * M_PI / 180;
constexpr std::uint64_t kFewest = 3;
constexpr double kMost = 0.5;
// An axis that is meant otherwise is off by 90 or 180 degrees, but for the ride.
constexpr double kRide = 12 * M_PI / 180;

bool IsNear(double angle, double other) { return std::abs(angle - other) < kRide; }

}  // namespace

void UprightJudge::Add(std::int64_t stamp, const Eigen::Quaterniond& q_WR) {
  if (gravity_W_.norm() == 0) return;
  const Eigen::Vector3d roof = q_WR * Eigen::Vector3d::UnitZ(), up = -gravity_W_;
  const double angle = std::atan2(up.cross(roof).norm(), up.dot(roof));
  if (count_++ == 0) first_ = stamp;
  last_ = stamp;
  if (angle < kLies) {
    run_ = Run();
    return;
  }
  if (run_.count++ == 0) {
    run_.first = stamp;
    run_.least = run_.most = angle;
  }
  run_.last = stamp;
  run_.least = std::min(run_.least, angle);
  run_.most = std::max(run_.most, angle);
  if (run_.count > longest_.count) longest_ = run_;
}

Findings UprightJudge::Report(const std::string& root, const std::string& world) const {
  const Run& run = longest_;
  if (run.count < kFewest || static_cast<double>(run.count) < kMost * static_cast<double>(count_))
    return {};
  const bool all = run.count == count_;
  const bool upside_down = run.least > kUpsideDown;
  Finding finding;
  finding.kind = upside_down ? "upside_down" : "on_its_side";
  finding.subject = "the vehicle";
  finding.what = std::string(upside_down ? "hangs upside down" : "lies on its side") +
                 (all ? " in all of the recording"
                      : " from " + StampText(run.first) +
                            (run.last == last_ ? " to the end" : " to " + StampText(run.last)) +
                            ", and stands upright " + (run.first > first_ ? "before" : "behind")) +
                 ": the z axis of '" + root + "' is " + Printed("%.0f", run.least * 180 / M_PI) +
                 " to " + Printed("%.0f deg", run.most * 180 / M_PI) +
                 " from up, so that gravity points out of its " + (upside_down ? "roof" : "side");
  const bool by_axis = (IsNear(run.least, M_PI / 2) && IsNear(run.most, M_PI / 2)) ||
                       (IsNear(run.least, M_PI) && IsNear(run.most, M_PI));
  finding.remedy = all ? ""
                       : "did it roll over there, or does its transform change? cut the recording "
                         "there (--start, --duration); or ";
  if (!by_axis) finding.remedy += "are roll and pitch in degrees where radians are meant? or ";
  finding.remedy +=
      "does the z axis of '" + world +
      "' point down? --gravity 0,0,9.81 (~gravity of the node) then; or do axes of '" + root +
      "' follow another convention than x forward, z up? turn its transform";
  finding.count = run.count;
  finding.first = finding.worst = run.first;
  finding.size = run.most;
  finding.limit = kLies;
  finding.unit = "rad";
  return {finding};
}

}  // namespace cosserat_cable
