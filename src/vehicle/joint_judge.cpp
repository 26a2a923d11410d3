#include "cosserat_cable/vehicle/joint_judge.h"

#include <algorithm>
#include <cmath>

#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {
namespace {

// Stops give way and zeros are not exact; more of the range than this is another position.
constexpr double kLimitTolerance = 0.01;
constexpr double kVelocityTolerance = 0.1;
// Encoder steps and late stamps make velocities between neighbours; over this they even out [s].
constexpr double kVelocityBase = 0.02;
// Calibrated mounts differ from the drawing by less [m], [rad].
constexpr double kOffAxis = 5e-3, kOffTurn = 0.02;
// Beyond the limits by this factor a unit is more likely than an overload.
constexpr double kUnitFactor = 1.5;
// As the other unit it would use this part of its range at least.
constexpr double kUsedPart = 0.02;
// A unit is wrong in all samples, an outlier in few of them.
constexpr double kHabit = 0.1;
constexpr double kDegree = M_PI / 180, kMillimetre = 1e-3;

double Wrapped(double angle) { return std::remainder(angle, 2 * M_PI); }

std::string Range(double lower, double upper) {
  return FormatRounded(lower, 4) + " to " + FormatRounded(upper, 4);
}

}  // namespace

JointReading ReadJoint(const JointModel& joint, const Pose& X_PC) {
  const Pose X = joint.X_PJ.Inverse() * X_PC;
  JointReading reading;
  if (joint.type == JointModel::Type::kRevolute) {
    reading.position = Wrapped(2 * std::atan2(X.q.vec().dot(joint.axis), X.q.w()));
    const Eigen::Quaterniond rest = RotationExp(-reading.position * joint.axis) * X.q;
    reading.off_turn = RotationLog(rest).norm();
    reading.off_axis = X.p.norm();
  } else {
    reading.position = X.p.dot(joint.axis);
    reading.off_axis = (X.p - reading.position * joint.axis).norm();
    reading.off_turn = RotationLog(X.q).norm();
  }
  return reading;
}

void JointJudge::Worst::Add(std::int64_t stamp, double new_size, double new_value) {
  if (count == 0) first = stamp;
  if (count == 0 || new_size > size) {
    worst = stamp;
    size = new_size;
    value = new_value;
  }
  ++count;
}

JointJudge::JointJudge(const JointModel& joint, double max_gap)
    : joint_(&joint),
      max_gap_(max_gap),
      tolerance_(std::isfinite(joint.upper - joint.lower)
                     ? kLimitTolerance * (joint.upper - joint.lower)
                     : 0) {}

void JointJudge::Restart() { has_last_ = false; }

void JointJudge::Add(std::int64_t stamp, double position) { Judge(stamp, position, false); }

void JointJudge::Add(std::int64_t stamp, const Pose& X_PC) {
  const JointReading reading = ReadJoint(*joint_, X_PC);
  if (reading.off_axis > kOffAxis) off_axis_.Add(stamp, reading.off_axis, reading.off_axis);
  if (reading.off_turn > kOffTurn) off_turn_.Add(stamp, reading.off_turn, reading.off_turn);
  double position = reading.position;
  // The turn that lies within the limits, where one does.
  if (turns() && std::isfinite(joint_->lower + joint_->upper)) {
    const double middle = (joint_->lower + joint_->upper) / 2;
    position = middle + Wrapped(position - middle);
  }
  Judge(stamp, position, turns());
}

void JointJudge::Judge(std::int64_t stamp, double position, bool wraps) {
  ++samples_;
  least_ = std::min(least_, position);
  most_ = std::max(most_, position);
  const double beyond = std::max(position - joint_->upper, joint_->lower - position);
  if (beyond > tolerance_) limit_.Add(stamp, beyond, position);

  const double h = static_cast<double>(stamp - last_) * 1e-9;
  if (!has_last_ || h > max_gap_) {
    has_last_ = true;
    base_ = stamp;
    travel_ = base_travel_ = 0;
  } else {
    const double step = wraps ? Wrapped(position - last_position_) : position - last_position_;
    if (turns() && std::abs(step) > M_PI) half_turn_.Add(stamp, std::abs(step), step);
    travel_ += step;
    const double span = static_cast<double>(stamp - base_) * 1e-9;
    if (span >= kVelocityBase) {
      const double velocity = (travel_ - base_travel_) / span;
      ++velocities_;
      if (std::abs(velocity) > (1 + kVelocityTolerance) * joint_->velocity)
        velocity_.Add(stamp, std::abs(velocity), velocity);
      base_ = stamp;
      base_travel_ = travel_;
    }
  }
  last_ = stamp;
  last_position_ = position;
}

Finding JointJudge::Start(const char* kind, const std::string& topic, const Worst& worst) const {
  Finding finding;
  finding.kind = kind;
  finding.subject = "joint '" + joint_->name + "'";
  finding.topic = topic;
  finding.count = worst.count;
  finding.first = worst.first;
  finding.worst = worst.worst;
  finding.size = worst.size;
  finding.unit = unit();
  return finding;
}

void JointJudge::ReportLimit(const std::string& topic, Findings* findings) const {
  if (limit_.count == 0) return;
  Finding finding = Start("joint_limit", topic, limit_);
  finding.size = limit_.value;
  finding.limit = limit_.value > joint_->upper ? joint_->upper : joint_->lower;
  finding.what = "is at " + Range(least_, most_) + " " + unit() + ", the URDF has " +
                 Range(joint_->lower, joint_->upper) + " (" + std::to_string(limit_.count) +
                 " samples outside)";
  const double scale = turns() ? kDegree : kMillimetre;
  const double reach = std::max(std::abs(joint_->lower), std::abs(joint_->upper));
  const bool unit_fits = scale * most_ <= joint_->upper + tolerance_ &&
                         scale * least_ >= joint_->lower - tolerance_ &&
                         std::abs(limit_.value) > kUnitFactor * reach &&
                         scale * std::abs(limit_.value) > kUsedPart * reach &&
                         static_cast<double>(limit_.count) > kHabit * static_cast<double>(samples_);
  if (unit_fits) {
    finding.kind = turns() ? "degrees" : "millimetres";
    finding.remedy = turns() ? "are these degrees? as such they all fit: publish radians"
                             : "are these millimetres? as such they all fit: publish metres";
  } else {
    finding.remedy = "is its zero, its sign or its limit wrong?";
  }
  findings->push_back(std::move(finding));
}

void JointJudge::ReportVelocity(const std::string& topic, Findings* findings) const {
  if (velocity_.count == 0) return;
  Finding finding = Start("joint_velocity", topic, velocity_);
  finding.limit = joint_->velocity;
  finding.unit += "/s";
  finding.what = "moves at up to " + FormatRounded(velocity_.size, 4) + " " + finding.unit +
                 ", the URDF has " + FormatRounded(joint_->velocity, 4);
  const double scale = turns() ? kDegree : kMillimetre;
  const bool unit_fits = scale * velocity_.size <= joint_->velocity;
  const bool often =
      static_cast<double>(velocity_.count) > kHabit * static_cast<double>(velocities_);
  if (unit_fits && often && velocity_.size > 1 / std::sqrt(scale) * joint_->velocity) {
    finding.remedy = turns() ? "are these degrees?" : "are these millimetres?";
  } else {
    finding.remedy = "does it jump, are its stamps wrong, or is its limit?";
  }
  findings->push_back(std::move(finding));
}

Findings JointJudge::Report(const std::string& topic) const {
  Findings findings;
  ReportLimit(topic, &findings);
  ReportVelocity(topic, &findings);
  if (half_turn_.count > 0) {
    Finding finding = Start("half_turn", topic, half_turn_);
    finding.limit = M_PI;
    finding.what = "turns by up to " + FormatRounded(half_turn_.size) +
                   " rad from one sample to the next, more than half a turn (" +
                   std::to_string(half_turn_.count) + " times)";
    finding.remedy = "which way it turned is not known: are these degrees, or is the rate too low?";
    findings.push_back(std::move(finding));
  }
  const bool by_turn = off_turn_.count > 0;
  if (by_turn || off_axis_.count > 0) {
    Finding finding = Start("off_axis", topic, by_turn ? off_turn_ : off_axis_);
    finding.limit = by_turn ? kOffTurn : kOffAxis;
    finding.unit = by_turn ? "rad" : "m";
    finding.what = "is a " + std::string(turns() ? "revolute" : "prismatic") +
                   " joint, and its transform is off its axis by up to " +
                   (by_turn ? FormatRounded(finding.size) + " rad" : FormatLength(finding.size));
    finding.remedy = "is this the URDF of the vehicle that was recorded?";
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace cosserat_cable
