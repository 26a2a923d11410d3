// A small vehicle and what drives it, for tests of LinkMotion.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cosserat_cable/ros/conversions.h"
#include "cosserat_cable/ros/link_motion.h"

namespace cosserat_cable::testing {

constexpr std::int64_t kStart = 1'000'000'000'000;  // [ns]
constexpr std::int64_t kPeriod = 10'000'000;        // 100 Hz

inline JointModel MakeJoint(const char* name, const char* parent, const char* child,
                            JointModel::Type type) {
  JointModel joint;
  joint.name = name;
  joint.parent = parent;
  joint.child = child;
  joint.type = type;
  joint.axis = Eigen::Vector3d::UnitZ();
  return joint;
}

// base -(travel)-> strut -(mount)-> carrier, and an arm that mimics the travel.
inline VehicleModel MakeVehicle() {
  VehicleModel vehicle;
  vehicle.root = "base";
  vehicle.links = {"base", "strut", "carrier", "arm"};
  vehicle.joints = {MakeJoint("travel", "base", "strut", JointModel::Type::kPrismatic),
                    MakeJoint("mount", "strut", "carrier", JointModel::Type::kFixed),
                    MakeJoint("arm_joint", "base", "arm", JointModel::Type::kRevolute)};
  vehicle.joints[1].X_PJ.p = {0, 0.5, 0};
  vehicle.joints[2].mimic = "travel";
  vehicle.joints[2].mimic_multiplier = 3;
  return vehicle;
}

inline tf2_msgs::TFMessage Transform(const char* parent, const char* child, std::int64_t stamp,
                                     const Pose& pose) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header.frame_id = parent;
  message.transforms[0].header.stamp = ToRosTime(stamp);
  message.transforms[0].child_frame_id = child;
  message.transforms[0].transform = ToTransform(pose);
  return message;
}

inline sensor_msgs::JointState Joints(std::int64_t stamp, double travel) {
  sensor_msgs::JointState message;
  message.header.stamp = ToRosTime(stamp);
  message.name = {"travel"};
  message.position = {travel};
  return message;
}

inline Pose BodyPose(double t) {
  Pose pose;
  pose.p = {15 * t, 0.02 * std::sin(9 * t), 0.3};
  pose.q = Eigen::AngleAxisd(0.1 * std::sin(5 * t), Eigen::Vector3d(1, 2, 3).normalized());
  return pose;
}

inline double Travel(double t) { return 0.03 * std::sin(20 * t); }

inline void Drive(LinkMotion* links, std::int64_t start, int samples) {
  for (int i = 0; i < samples; ++i) {
    const std::int64_t stamp = start + i * kPeriod;
    const double t = 1e-9 * static_cast<double>(i * kPeriod);
    links->Ingest(Transform("odom", "base", stamp, BodyPose(t)), false);
    links->Ingest(Joints(stamp, Travel(t)));
  }
}

class LinkMotionTest : public ::testing::Test {
 protected:
  VehicleModel vehicle_ = MakeVehicle();
  std::vector<std::string> needed_ = {"base", "carrier", "arm"};
  LinkMotionOptions options_;
};

inline bool Says(const std::vector<std::string>& sentences, const std::string& words) {
  return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& sentence) {
    return sentence.find(words) != std::string::npos;
  });
}

// ---- What contradicts itself -----------------------------------------------------------------

inline Pose Shifted(double x) {
  Pose pose;
  pose.p.x() = x;
  return pose;
}

inline const Finding* FindKind(const Findings& findings, const std::string& kind) {
  const auto found = std::find_if(findings.begin(), findings.end(),
                                  [&](const Finding& finding) { return finding.kind == kind; });
  return found == findings.end() ? nullptr : &*found;
}

}  // namespace cosserat_cable::testing
