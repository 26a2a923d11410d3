#include "cosserat_cable/vehicle/attitude_judge.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {
namespace {

// Long beside noise, short beside the sway of a body on its springs [ns].
constexpr std::int64_t kPart = 100'000'000;
constexpr std::uint64_t kFewestParts = 10;
// A body that rolls over tips by so much twice; one whose angles are degrees does so all the time.
constexpr double kSwing = M_PI / 3;
constexpr std::uint64_t kFewestSwings = 4;
// Bodies on springs tip at up to 1 rad/s for a moment; nothing on wheels turns faster than 1.5
// turns a second [rad/s].
constexpr double kTips = 2, kTurns = 10;
constexpr double kShare = 0.1;  // of the parts

}  // namespace

void AttitudeJudge::Add(std::int64_t stamp, const Eigen::Quaterniond& q_PC) {
  const Eigen::Vector3d z = q_PC * Eigen::Vector3d::UnitZ();
  AddTilt(stamp, std::atan2(std::hypot(z.x(), z.y()), z.z()));
  const std::int64_t interval = stamp - last_;
  if (has_last_ && interval < kPart) return;
  const double h = static_cast<double>(interval) * 1e-9;
  if (has_last_ && h <= max_gap_ + 1e-9 * static_cast<double>(kPart)) {
    const Eigen::Vector3d before = q_last_ * Eigen::Vector3d::UnitZ();
    const double tips = std::atan2(before.cross(z).norm(), before.dot(z)) / h;
    const double turns = q_last_.angularDistance(q_PC) / h;
    ++parts_;
    squared_tips_ += tips * tips;
    if (turns > kTurns) ++fast_;
    if (turns > fastest_) {
      fastest_ = turns;
      fastest_at_ = stamp;
    }
  }
  has_last_ = true;
  last_ = stamp;
  q_last_ = q_PC;
}

void AttitudeJudge::AddTilt(std::int64_t stamp, double tilt) {
  if (!has_tilt_) {
    has_tilt_ = true;
    far_ = least_ = most_ = tilt;
  }
  least_ = std::min(least_, tilt);
  most_ = std::max(most_, tilt);
  far_ = rises_ ? std::max(far_, tilt) : std::min(far_, tilt);
  if (std::abs(far_ - tilt) < kSwing) return;
  // It has turned round there.
  if (swings_++ == 0) first_swing_ = stamp;
  rises_ = !rises_;
  far_ = tilt;
}

Findings AttitudeJudge::Report(const std::string& subject, const std::string& topic) const {
  if (parts_ < kFewestParts) return {};
  const auto parts = static_cast<double>(parts_);
  const bool swings = swings_ >= kFewestSwings;
  const bool tips = std::sqrt(squared_tips_ / parts) > kTips;
  const bool turns = static_cast<double>(fast_) > kShare * parts;
  if (!swings && !tips && !turns) return {};
  Finding finding;
  finding.kind = "degrees";
  finding.subject = subject;
  finding.topic = topic;
  finding.what = "turns at up to " + FormatRounded(fastest_) + " rad/s";
  if (swings || tips)
    finding.what += ", and tips from " + Printed("%.0f", least_ * 180 / M_PI) + " to " +
                    Printed("%.0f deg", most_ * 180 / M_PI) +
                    (swings ? " and back, " + std::to_string(swings_) + " times" : "");
  finding.what += ": no vehicle's body does";
  finding.remedy =
      "are roll, pitch or yaw in degrees where radians are meant? publish the orientation of the "
      "angles in radians";
  finding.count = swings ? swings_ : parts_;
  finding.first = swings ? first_swing_ : fastest_at_;
  finding.worst = fastest_at_;
  finding.size = fastest_;
  finding.limit = kTurns;
  finding.unit = "rad/s";
  return {finding};
}

}  // namespace cosserat_cable
