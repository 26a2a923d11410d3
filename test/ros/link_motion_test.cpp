#include "cosserat_cable/ros/link_motion.h"

#include <gtest/gtest.h>
#include <tf2/buffer_core.h>

#include <algorithm>
#include <cmath>

#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

constexpr std::int64_t kStart = 1'000'000'000'000;  // [ns]
constexpr std::int64_t kPeriod = 10'000'000;        // 100 Hz

JointModel MakeJoint(const char* name, const char* parent, const char* child,
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
VehicleModel MakeVehicle() {
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

tf2_msgs::TFMessage Transform(const char* parent, const char* child, std::int64_t stamp,
                              const Pose& pose) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header.frame_id = parent;
  message.transforms[0].header.stamp = ToRosTime(stamp);
  message.transforms[0].child_frame_id = child;
  message.transforms[0].transform = ToTransform(pose);
  return message;
}

sensor_msgs::JointState Joints(std::int64_t stamp, double travel) {
  sensor_msgs::JointState message;
  message.header.stamp = ToRosTime(stamp);
  message.name = {"travel"};
  message.position = {travel};
  return message;
}

Pose BodyPose(double t) {
  Pose pose;
  pose.p = {15 * t, 0.02 * std::sin(9 * t), 0.3};
  pose.q = Eigen::AngleAxisd(0.1 * std::sin(5 * t), Eigen::Vector3d(1, 2, 3).normalized());
  return pose;
}

double Travel(double t) { return 0.03 * std::sin(20 * t); }

void Drive(LinkMotion* links, std::int64_t start, int samples) {
  for (int i = 0; i < samples; ++i) {
    const std::int64_t stamp = start + i * kPeriod;
    const double t = 1e-9 * static_cast<double>(i * kPeriod);
    links->Ingest(Transform("odom", "base", stamp, BodyPose(t)), false);
    links->Ingest(Joints(stamp, Travel(t)));
  }
}

class LinkMotionTest : public testing::Test {
 protected:
  VehicleModel vehicle_ = MakeVehicle();
  std::vector<std::string> needed_ = {"base", "carrier", "arm"};
  LinkMotionOptions options_;
};

// What robot_state_publisher says of the vehicle at that time, and what moves its base.
void TellTf2(std::int64_t stamp, tf2::BufferCore* buffer) {
  const double t = 1e-9 * static_cast<double>(stamp - kStart);
  const double travel = Travel(t);
  Pose strut, carrier, arm;
  strut.p.z() = travel;
  carrier.p.y() = 0.5;
  arm.q = Eigen::AngleAxisd(3 * travel, Eigen::Vector3d::UnitZ());
  for (const auto& message :
       {Transform("odom", "base", stamp, BodyPose(t)), Transform("base", "strut", stamp, strut),
        Transform("strut", "carrier", stamp, carrier), Transform("base", "arm", stamp, arm)})
    ASSERT_TRUE(buffer->setTransform(message.transforms[0], "test"));
}

TEST_F(LinkMotionTest, FollowsWhatTf2Says) {
  LinkMotion links(vehicle_, needed_, options_);
  constexpr int kSamples = 60;
  Drive(&links, kStart, kSamples);
  tf2::BufferCore buffer;
  for (int i = 0; i < kSamples; ++i) TellTf2(kStart + i * kPeriod, &buffer);
  EXPECT_EQ(links.world(), "odom");
  EXPECT_TRUE(links.Missing().empty());
  std::int64_t begin = 0, ready = 0;
  ASSERT_TRUE(links.Range(&begin, &ready));
  EXPECT_EQ(begin, kStart);
  // At the samples themselves tf2 interpolates nothing. Rounding through metres of 15 m/s and
  // quaternions.
  constexpr double kRounding = 1e-12;
  for (std::int64_t stamp = begin; stamp <= ready; stamp += kPeriod) {
    for (const std::string& link : needed_) {
      const Pose X = links.Evaluate(link, stamp).X;
      Pose expected;
      ASSERT_TRUE(
          ToPose(buffer.lookupTransform("odom", link, ToRosTime(stamp)).transform, &expected));
      EXPECT_LT((X.p - expected.p).norm(), kRounding) << link;
      EXPECT_LT(X.q.angularDistance(expected.q), 1e-7) << link;  // acos near 1
    }
  }
}

TEST_F(LinkMotionTest, SaysWhatIsMissing) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Transform("odom", "base", kStart, Pose()), false);
  const std::vector<std::string> missing = links.Missing();
  ASSERT_EQ(missing.size(), 2u);
  EXPECT_NE(missing[0].find("'arm_joint'"), std::string::npos);
  EXPECT_NE(missing[1].find("'travel'"), std::string::npos);
}

TEST_F(LinkMotionTest, HeldJointsNeedNoData) {
  options_.held_joints = {"travel", "arm_joint"};
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Transform("odom", "base", kStart, Pose()), false);
  EXPECT_TRUE(links.Missing().empty());
}

TEST_F(LinkMotionTest, WorldFrameThatIsNowhereIsMissing) {
  options_.world_frame = "map";
  LinkMotion links(vehicle_, needed_, options_);
  Drive(&links, kStart, 3);
  ASSERT_FALSE(links.Missing().empty());
  EXPECT_NE(links.Missing()[0].find("'map'"), std::string::npos);
}

TEST_F(LinkMotionTest, AJointsStateCountsMoreThanTheTransformMadeOfIt) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Transform("base", "strut", kStart, Pose()), false);
  EXPECT_EQ(links.edges().at("strut").source, LinkMotion::Source::kTf);
  Drive(&links, kStart, 30);
  EXPECT_EQ(links.edges().at("strut").source, LinkMotion::Source::kJointStates);
  EXPECT_EQ(links.edges().at("strut").samples, 30u);  // the first one had the transform's stamp
  links.Ingest(Transform("base", "strut", kStart + 10'000'000'000, Pose()), false);
  EXPECT_EQ(links.edges().at("strut").samples, 30u);
  EXPECT_EQ(links.warnings().counts().count("frame 'strut' comes from two sources"), 0u);
}

TEST_F(LinkMotionTest, TimeRunningBackwardsForgetsTheSamples) {
  LinkMotion links(vehicle_, needed_, options_);
  Drive(&links, kStart, 100);
  Drive(&links, kStart, 40);
  EXPECT_EQ(links.clear_count(), 1u);
  std::int64_t begin = 0, ready = 0;
  ASSERT_TRUE(links.Range(&begin, &ready));
  EXPECT_EQ(begin, kStart);
  EXPECT_LE(ready, kStart + 39 * kPeriod);
}

TEST_F(LinkMotionTest, OldAndRepeatedSamplesAreCountedAndIgnored) {
  LinkMotion links(vehicle_, needed_, options_);
  Drive(&links, kStart, 10);
  links.Ingest(Joints(kStart + 9 * kPeriod, 0.5));
  links.Ingest(Joints(kStart + 8 * kPeriod, 0.5));
  EXPECT_EQ(links.edges().at("strut").samples, 10u);
  // The arm follows the strut, so each joint state is two samples.
  EXPECT_EQ(links.warnings().counts().at("sample repeated with the same stamp"), 2u);
  EXPECT_EQ(links.warnings().counts().at("sample older than the one before it"), 2u);
  EXPECT_EQ(links.clear_count(), 0u);
}

TEST_F(LinkMotionTest, UnusableSamplesAreCountedAndIgnored) {
  LinkMotion links(vehicle_, needed_, options_);
  auto bad = Transform("odom", "base", kStart, Pose());
  bad.transforms[0].transform.rotation.w = 0;
  links.Ingest(bad, false);
  bad.transforms[0].transform.rotation.w = NAN;
  links.Ingest(bad, false);
  links.Ingest(Transform("odom", "odom", kStart, Pose()), false);
  links.Ingest(Joints(kStart, NAN));
  sensor_msgs::JointState none = Joints(kStart, 0);
  none.position.clear();
  links.Ingest(none);
  links.Ingest(Transform("odom", "base", 0, Pose()), false);
  EXPECT_EQ(links.edges().count("base"), 0u);
  EXPECT_EQ(links.warnings().counts().size(), 5u);
  EXPECT_EQ(links.warnings().TakeNew().size(), 5u);
  EXPECT_TRUE(links.warnings().TakeNew().empty());
}

TEST_F(LinkMotionTest, GapsAreCounted) {
  LinkMotion links(vehicle_, needed_, options_);
  Drive(&links, kStart, 20);
  const std::int64_t later = kStart + 500'000'000;
  Drive(&links, later, 20);
  // base, strut and arm.
  EXPECT_EQ(links.gap_count(), 3u);
  links.Finish();
  EXPECT_TRUE(links.InGap("carrier", kStart + 300'000'000));
  EXPECT_FALSE(links.InGap("carrier", kStart + 100'000'000));
}

TEST_F(LinkMotionTest, AConstantTransformThatIsSentSlowlyHasNoGaps) {
  LinkMotion links(vehicle_, needed_, options_);
  for (std::int64_t i = 0; i < 5; ++i) {
    links.Ingest(Transform("world", "odom", kStart + i * 1'000'000'000, BodyPose(1)), false);
    Drive(&links, kStart + i * 1'000'000'000, 100);
  }
  links.Finish();
  EXPECT_EQ(links.gap_count(), 0u);
  EXPECT_FALSE(links.InGap("carrier", kStart + 500'000'000));
}

TEST_F(LinkMotionTest, ASlowTransformThatMovesHasGaps) {
  LinkMotion links(vehicle_, needed_, options_);
  for (std::int64_t i = 0; i < 5; ++i) {
    links.Ingest(Transform("world", "odom", kStart + i * 1'000'000'000, BodyPose(i)), false);
    Drive(&links, kStart + i * 1'000'000'000, 100);
  }
  links.Finish();
  EXPECT_EQ(links.gap_count(), 4u);
  EXPECT_TRUE(links.InGap("carrier", kStart + 1'500'000'000));
}

TEST_F(LinkMotionTest, FindsTheFrameBelowALocalisation) {
  LinkMotion links(vehicle_, needed_, options_);
  Drive(&links, kStart, 1000);
  for (std::int64_t i = 0; i < 100; ++i) {
    Pose corrected;
    corrected.p.x() = i < 50 ? 7 : 7.1;
    links.Ingest(Transform("map", "odom", kStart + i * 100'000'000, corrected), false);
  }
  links.Finish();
  EXPECT_EQ(links.world(), "map");
  EXPECT_EQ(links.SmoothWorld(), "odom");
  const Findings findings = links.MotionFindings(links.world());
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].subject, "map -> odom");
  EXPECT_EQ(findings[0].topic, "/tf");
  EXPECT_EQ(findings[0].worst, kStart + 5'000'000'000);
}

TEST_F(LinkMotionTest, TellsACorrectionInAShortRecordingToo) {
  LinkMotion links(vehicle_, needed_, options_);
  Drive(&links, kStart, 200);
  for (std::int64_t i = 0; i < 20; ++i) {
    Pose corrected;
    corrected.p.x() = i < 10 ? 7 : 7.1;
    links.Ingest(Transform("map", "odom", kStart + i * 100'000'000, corrected), false);
  }
  links.Finish();
  EXPECT_EQ(links.SmoothWorld(), "odom");
  const Findings findings = links.MotionFindings(links.world());
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].subject, "map -> odom");
  EXPECT_EQ(findings[0].worst, kStart + 1'000'000'000);
}

TEST_F(LinkMotionTest, WhatTheUserTakesAsInertialIsNotJudgedFromAbove) {
  options_.world_frame = "odom";
  LinkMotion links(vehicle_, needed_, options_);
  Drive(&links, kStart, 200);
  for (std::int64_t i = 0; i < 20; ++i) {
    Pose corrected;
    corrected.p.x() = i < 10 ? 7 : 7.1;
    links.Ingest(Transform("map", "odom", kStart + i * 100'000'000, corrected), false);
  }
  EXPECT_EQ(links.SmoothWorld(), "odom");
  EXPECT_TRUE(links.MotionFindings("odom").empty());
}

TEST_F(LinkMotionTest, SmoothedLinksFollowTheSameMotion) {
  options_.smooth = 30;
  LinkMotion links(vehicle_, needed_, options_);
  Drive(&links, kStart, 400);
  links.Finish();
  std::int64_t begin = 0, ready = 0;
  ASSERT_TRUE(links.Range(&begin, &ready));
  EXPECT_EQ(begin, kStart);
  EXPECT_EQ(ready, kStart + 399 * kPeriod);
  // 20 rad/s at a cutoff of 30 Hz: (1 + u) exp(-u) is short of 1 by u^2 / 2, u = 0.012.
  constexpr double kLost = 1e-4;
  for (double t = 1; t < 3; t += 0.0137) {
    const Motion motion = links.Evaluate("base", kStart + static_cast<std::int64_t>(t * 1e9));
    EXPECT_LT((motion.X.p - BodyPose(t).p).norm(), kLost);
    EXPECT_NEAR(motion.v.x(), 15, 0.01);
  }
}

TEST_F(LinkMotionTest, TwoPublishersOfAJointAreTold) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 200; ++i) {
    const std::int64_t stamp = kStart + i * kPeriod;
    const double t = 1e-9 * static_cast<double>(i * kPeriod);
    links.Ingest(Transform("odom", "base", stamp, BodyPose(t)), false, "/odometry");
    links.Ingest(Joints(stamp, Travel(t)), "/driver");
    if (i % 10 == 5) links.Ingest(Joints(stamp + kPeriod / 4, 0), "/joint_state_publisher");
  }
  bool told = false;
  for (const Finding& finding : links.MotionFindings("odom")) {
    if (finding.kind != "two_publishers" || finding.subject != "joint 'travel'") continue;
    told = true;
    EXPECT_NE(finding.what.find("/joint_state_publisher"), std::string::npos);
  }
  EXPECT_TRUE(told);
}

TEST_F(LinkMotionTest, LeadingSlashesOfOldRecordingsAreDropped) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Transform("/odom", "/base", kStart, Pose()), false);
  EXPECT_EQ(links.edges().at("base").parent, "odom");
}

bool Says(const std::vector<std::string>& sentences, const std::string& words) {
  return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& sentence) {
    return sentence.find(words) != std::string::npos;
  });
}

// A sample that is there without a stamp is not one that is missing.
TEST(LinkMotion, SamplesWithoutStampsAreNamedAsSuch) {
  const VehicleModel vehicle = MakeVehicle();
  LinkMotion links(vehicle, {"base", "strut"}, {});
  for (int i = 0; i < 7; ++i) links.Ingest(Joints(0, 0.01 * i));
  EXPECT_TRUE(Says(links.Missing(), "all 7 samples of it by /joint_states have no stamp"));
  EXPECT_TRUE(Says(links.Missing(), "--use-record-times"));
  EXPECT_FALSE(Says(links.Missing(), "neither"));
}

// The body would stand still, and nobody would be told.
TEST(LinkMotion, ABodyMovedWithoutStampsIsMissing) {
  const VehicleModel vehicle = MakeVehicle();
  LinkMotion links(vehicle, {"base", "strut"}, {});
  for (int i = 0; i < 7; ++i) {
    links.Ingest(Joints(kStart + i * kPeriod, 0.01 * i));
    links.Ingest(Transform("odom", "base", 0, BodyPose(0.01 * i)), false);
  }
  EXPECT_TRUE(Says(links.Missing(), "frame 'base' is moved in 'odom'"));
  LinkMotionOptions options;
  options.world_frame = "base";
  LinkMotion fixed(vehicle, {"base", "strut"}, options);
  for (int i = 0; i < 7; ++i) {
    fixed.Ingest(Joints(kStart + i * kPeriod, 0.01 * i));
    fixed.Ingest(Transform("odom", "base", 0, BodyPose(0.01 * i)), false);
  }
  EXPECT_TRUE(fixed.Missing().empty());
}

TEST(LinkMotion, StampsThatArePartlyZeroAreAdvisedOn) {
  const VehicleModel vehicle = MakeVehicle();
  LinkMotion links(vehicle, {"strut"}, {});
  for (int i = 0; i < 10; ++i) links.Ingest(Joints(i % 2 == 0 ? kStart + i * kPeriod : 0, 0.0));
  EXPECT_TRUE(links.Missing().empty());
  // Of the strut, and of the arm that follows it.
  EXPECT_TRUE(Says(links.Advice(), "10 samples by /joint_states have no stamp"));
  LinkMotion frozen(vehicle, {"strut"}, {});
  for (int i = 0; i < 10; ++i) frozen.Ingest(Joints(kStart, 0.01 * i));
  EXPECT_TRUE(Says(frozen.Advice(), "have one and the same stamp"));
}

TEST(LinkMotion, PrefixesAreAdvisedOnAndTakenOff) {
  const VehicleModel vehicle = MakeVehicle();
  sensor_msgs::JointState joints = Joints(kStart, 0.02);
  joints.name = {"rover1/travel"};
  const auto drive = [&](LinkMotion* links) {
    for (int i = 0; i < 20; ++i) {
      joints.header.stamp = ToRosTime(kStart + i * kPeriod);
      links->Ingest(joints);
      links->Ingest(
          Transform("rover1/odom", "rover1/base", kStart + i * kPeriod, BodyPose(0.01 * i)), false);
    }
    links->Finish();
  };
  LinkMotion plain(vehicle, {"base", "strut"}, {});
  drive(&plain);
  EXPECT_TRUE(Says(plain.Missing(), "neither /tf nor /joint_states drives it"));
  EXPECT_TRUE(Says(plain.Advice(), "'rover1/base'"));
  EXPECT_TRUE(Says(plain.Advice(), "'rover1/travel'"));
  EXPECT_TRUE(Says(plain.Advice(), "--tf-prefix rover1 takes it off"));

  for (const char* prefix : {"rover1", "rover1/", "/rover1"}) {
    LinkMotionOptions options;
    options.tf_prefix = prefix;
    LinkMotion links(vehicle, {"base", "strut"}, options);
    drive(&links);
    EXPECT_TRUE(links.Missing().empty());
    EXPECT_EQ(links.world(), "odom");
    constexpr double kRounding = 1e-9;  // [m] of a position near zero
    const Pose X_BS =
        links.Evaluate("base", kStart).X.Inverse() * links.Evaluate("strut", kStart).X;
    EXPECT_NEAR(X_BS.p.z(), 0.02, kRounding);
    EXPECT_TRUE(links.Advice().empty());
  }
}

TEST(LinkMotion, TopicsAreCalledByTheirNames) {
  LinkMotionOptions options;
  options.topics.joint_states = "/rover1/joint_states";
  options.topics.tf = "/rover1/tf";
  const VehicleModel vehicle = MakeVehicle();
  const LinkMotion links(vehicle, {"strut"}, options);
  EXPECT_TRUE(Says(links.Missing(), "neither /rover1/tf nor /rover1/joint_states drives it"));
}

// ---- What contradicts itself -----------------------------------------------------------------

Pose Shifted(double x) {
  Pose pose;
  pose.p.x() = x;
  return pose;
}

const Finding* FindKind(const Findings& findings, const std::string& kind) {
  const auto found = std::find_if(findings.begin(), findings.end(),
                                  [&](const Finding& finding) { return finding.kind == kind; });
  return found == findings.end() ? nullptr : &*found;
}

TEST_F(LinkMotionTest, OneBadStampIsLeftOutAndTold) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  for (const std::int64_t off : {10 * kSecond, -2 * kSecond, kPeriod - 1, kPeriod / 2 * 3}) {
    LinkMotion links(vehicle_, needed_, options_);
    for (int i = 0; i < 200; ++i) {
      const std::int64_t stamp = kStart + i * kPeriod;
      const double t = 1e-9 * static_cast<double>(i * kPeriod);
      links.Ingest(Transform("odom", "base", stamp + (i == 100 ? off : 0), BodyPose(t)), false);
      links.Ingest(Joints(stamp, Travel(t)));
    }
    links.Finish();
    EXPECT_EQ(links.clear_count(), 0u) << off;
    EXPECT_EQ(links.edges().at("base").samples, 199u) << off;
    ASSERT_EQ(links.warnings().counts().size(), 1u) << off;
    EXPECT_EQ(links.warnings().counts().at("sample with a bad stamp"), 1u) << off;
    EXPECT_TRUE(Says(links.warnings().Sentences(kStart), "frame 'base' by /tf"));
    EXPECT_TRUE(Says(links.warnings().Sentences(kStart), off > 0 ? "too late" : "too early"));
    // The body rolls on at 15 m/s.
    EXPECT_NEAR(links.Evaluate("base", kStart + 100 * kPeriod).X.p.x(), 15, 1e-3) << off;
    EXPECT_EQ(FindKind(links.MotionFindings("odom"), "jump"), nullptr) << off;
  }
}

TEST_F(LinkMotionTest, MessagesThatOvertakeEachOtherKeepTheirStamps) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 200; ++i) {
    // The 100th and the next one change places.
    const int k = i == 100 ? 101 : i == 101 ? 100 : i;
    links.Ingest(Transform("odom", "base", kStart + k * kPeriod, BodyPose(0.01 * k)), false);
    links.Ingest(Joints(kStart + i * kPeriod, Travel(0.01 * i)));
  }
  links.Finish();
  EXPECT_EQ(links.edges().at("base").samples, 200u);
  EXPECT_TRUE(links.warnings().counts().empty());
}

TEST_F(LinkMotionTest, MessagesThatOvertakeEachOtherByFarAreRecordedLate) {
  LinkMotion links(vehicle_, needed_, options_);
  std::vector<std::pair<std::int64_t, int>> order;  // of recording
  for (int i = 0; i < 400; ++i) order.emplace_back(kStart + i * kPeriod + (i * 7 % 5) * kPeriod, i);
  std::sort(order.begin(), order.end());
  for (const auto& [recorded, i] : order)
    links.Ingest(Transform("odom", "base", kStart + i * kPeriod, BodyPose(0.01 * i)), false, "",
                 recorded);
  links.Finish();
  EXPECT_EQ(links.warnings().counts().count("sample with a bad stamp"), 0u);
}

TEST_F(LinkMotionTest, SamplesRepeatedBehindAGapAreCountedAsSuch) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 100; ++i) {
    if (i == 50) continue;
    for (int n = 0; n < 2; ++n)
      links.Ingest(Transform("odom", "base", kStart + i * kPeriod, BodyPose(0.01 * i)), false);
  }
  links.Finish();
  EXPECT_EQ(links.edges().at("base").samples, 99u);
  ASSERT_EQ(links.warnings().counts().size(), 1u);
  EXPECT_EQ(links.warnings().counts().at("sample repeated with the same stamp"), 99u);
}

TEST_F(LinkMotionTest, AFirstStampThatIsWrongIsLeftOut) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 100; ++i) {
    const std::int64_t now = kStart + i * kPeriod;
    const std::int64_t stamp = i == 0 ? 5'000'000'000 : now;
    links.Ingest(Transform("odom", "base", stamp, BodyPose(0.01 * i)), false, "", now);
    links.Ingest(Joints(now, Travel(0.01 * i)), "", now);
  }
  links.Finish();
  EXPECT_EQ(links.Start(), kStart);
  EXPECT_EQ(links.edges().at("base").first, kStart + kPeriod);
  std::int64_t begin = 0, ready = 0;
  ASSERT_TRUE(links.Range(&begin, &ready));
  EXPECT_EQ(begin, kStart + kPeriod);
  EXPECT_EQ(links.warnings().counts().at("sample with a bad stamp"), 1u);
  EXPECT_TRUE(links.MotionFindings("odom").empty());
  bool nothing = false;
  EXPECT_TRUE(links.CoverageFindings("odom", &nothing).empty());
}

TEST_F(LinkMotionTest, AClockThatGoesAtAnotherRateIsTold) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t now = kStart + i * kPeriod;
    links.Ingest(Transform("odom", "base", now, BodyPose(0.01 * i)), false, "", now);
    links.Ingest(Joints(now + i * kPeriod / 50, Travel(0.01 * i)), "", now);
  }
  links.Finish();
  const Findings findings = links.MotionFindings("odom");
  const Finding* drifts = FindKind(findings, "clock_drifts");
  ASSERT_NE(drifts, nullptr);
  EXPECT_EQ(drifts->subject, "/joint_states");
  // 2 % of the 10 s, between the middles of the first and the last eighth.
  EXPECT_NEAR(drifts->size, -0.02 * 10 * 7 / 8, 0.01);
}

TEST_F(LinkMotionTest, AnEdgeThatWasSentOnceLimitsTheRun) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Transform("map", "odom", kStart, Shifted(3)), false);
  Drive(&links, kStart, 400);
  links.Finish();
  bool nothing = false;
  const Findings findings = links.CoverageFindings("map", &nothing);
  EXPECT_TRUE(nothing);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].subject, "map -> odom");
  EXPECT_EQ(findings[0].topic, "/tf");
  EXPECT_EQ(findings[0].count, 1u);
  EXPECT_EQ(findings[0].worst, kStart);
  EXPECT_NEAR(findings[0].size, 3.99, 1e-9);
  EXPECT_NE(findings[0].remedy.find("/tf_static"), std::string::npos);
  EXPECT_NE(findings[0].remedy.find("--world-frame odom"), std::string::npos);
  EXPECT_TRUE(links.CoverageFindings("odom", &nothing).empty());
  EXPECT_FALSE(nothing);
}

TEST_F(LinkMotionTest, WhatComesBeforeTheFramesBelowItCountsToo) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Transform("map", "odom", kStart, Shifted(3)), false);
  Drive(&links, kStart, 50);
  links.Ingest(Transform("map", "odom", kStart + 49 * kPeriod, Shifted(3)), false);
  links.Finish();
  std::int64_t begin = 0, ready = 0;
  ASSERT_TRUE(links.Range(&begin, &ready));
  EXPECT_EQ(begin, kStart);
  EXPECT_EQ(ready, kStart + 49 * kPeriod);
}

// As the old static_transform_publisher does.
TEST_F(LinkMotionTest, AConstantTransformThatIsStampedAheadIsNoOtherClock) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 10; ++i) {
    const std::int64_t now = kStart + i * 100 * kPeriod;
    links.Ingest(Transform("world", "odom", now + 100 * kPeriod, Shifted(3)), false);
    Drive(&links, now, 100);
  }
  links.Finish();
  bool nothing = false;
  const Findings findings = links.CoverageFindings("world", &nothing);
  EXPECT_FALSE(nothing);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].subject, "world -> odom");
  EXPECT_NE(findings[0].what.find("the run has 8.990 s of 9.990 s"), std::string::npos)
      << findings[0].what;
  EXPECT_NE(findings[0].remedy.find("/tf_static"), std::string::npos);
}

TEST_F(LinkMotionTest, AnEdgeThatEndsEarlyLimitsTheRun) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 4; ++i) {
    const std::int64_t stamp = kStart + i * 100 * kPeriod;
    links.Ingest(Transform("map", "odom", stamp, Shifted(3)), false);
    Drive(&links, stamp, i < 3 ? 100 : 96);
  }
  links.Finish();
  bool nothing = false;
  const Findings findings = links.CoverageFindings("map", &nothing);
  EXPECT_FALSE(nothing);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_NEAR(findings[0].size, 0.95, 1e-9);
  EXPECT_NE(findings[0].what.find("the run has 3.000 s of 3.950 s"), std::string::npos)
      << findings[0].what;
}

TEST_F(LinkMotionTest, ATopicOfAnotherClockIsTold) {
  constexpr std::int64_t kLate = 1'500'000'000;
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 400; ++i) {
    const std::int64_t now = kStart + i * kPeriod;
    links.Ingest(Transform("odom", "base", now, BodyPose(0.01 * i)), false, "", now + 2'000'000);
    links.Ingest(Joints(now - kLate, Travel(0.01 * i)), "", now + 3'000'000);
  }
  links.Finish();
  EXPECT_EQ(links.Start(), kStart);
  const Findings findings = links.MotionFindings("odom");
  const Finding* off = FindKind(findings, "clock_off");
  ASSERT_NE(off, nullptr);
  EXPECT_EQ(off->subject, "/joint_states");
  EXPECT_NEAR(off->size, 1.501, 1e-6);
  EXPECT_NE(off->what.find("1.5 s behind"), std::string::npos);
  // By the stamps alone.
  bool nothing = false;
  const Findings coverage = links.CoverageFindings("odom", &nothing);
  ASSERT_EQ(coverage.size(), 1u);
  EXPECT_NE(coverage[0].remedy.find("begins and ends 1.5 s before odom -> base"), std::string::npos)
      << coverage[0].remedy;
}

TEST_F(LinkMotionTest, GapsAreToldWithTimeAndSize) {
  for (const bool clock : {false, true}) {
    LinkMotion links(vehicle_, needed_, options_);
    for (int i = 0; i < 400; ++i) {
      const std::int64_t now = kStart + (i + (i > 200 ? 80 : 0)) * kPeriod;
      const std::int64_t recorded = clock ? kStart + i * kPeriod : now;
      links.Ingest(Transform("odom", "base", now, BodyPose(0.01 * i)), false, "", recorded);
      links.Ingest(Joints(now, Travel(0.01 * i)), "", recorded);
    }
    links.Finish();
    const Findings findings = links.MotionFindings("odom");
    const Finding* gap = FindKind(findings, clock ? "clock_jump" : "gap");
    ASSERT_NE(gap, nullptr);
    EXPECT_EQ(gap->subject, "odom -> base");
    EXPECT_EQ(gap->count, 1u);
    EXPECT_EQ(gap->first, kStart + 200 * kPeriod);
    EXPECT_NEAR(gap->size, 0.81, 1e-9);
    EXPECT_EQ(FindKind(findings, "jump"), nullptr);
  }
}

TEST_F(LinkMotionTest, AFixedFrameThatIsElsewhereOnTfIsToldWithItsSize) {
  LinkMotion links(vehicle_, needed_, options_);
  Drive(&links, kStart, 10);
  Pose mount;
  mount.p.y() = 0.5;
  links.Ingest(Transform("strut", "carrier", kStart, mount), false);
  EXPECT_TRUE(links.warnings().counts().empty());
  mount.p.y() = 0.55;
  for (int i = 3; i < 10; ++i)
    links.Ingest(Transform("strut", "carrier", kStart + i * kPeriod, mount), false);
  const std::vector<std::string> sentences = links.warnings().Sentences(kStart);
  ASSERT_EQ(sentences.size(), 1u);
  for (const char* words :
       {"frame 'carrier' comes from two sources: 7", "the URDF is kept, /tf is ignored",
        "by up to 50 mm", "(0.030 s after the start)", "/tf_static"})
    EXPECT_TRUE(Says(sentences, words)) << sentences[0];
}

TEST_F(LinkMotionTest, AnotherParentThanTheUrdfsIsTold) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Transform("odom", "strut", kStart, Pose()), false);
  const std::vector<std::string> sentences = links.warnings().Sentences();
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_TRUE(Says(sentences, "frame 'strut' has another parent than in the URDF"));
  EXPECT_TRUE(Says(sentences, "the URDF has 'base' (joint 'travel')"));
  EXPECT_TRUE(Says(sentences, "is this the URDF"));
}

TEST_F(LinkMotionTest, ABodyThatMovesUnderAnotherNameIsTold) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 400; ++i) {
    const std::int64_t now = kStart + i * kPeriod;
    links.Ingest(Transform("odom", "base_footprint", now, BodyPose(0.01 * i)), false);
    links.Ingest(Joints(now, Travel(0.01 * i)));
  }
  links.Finish();
  const Findings findings = links.MotionFindings("base");
  const Finding* unconnected = FindKind(findings, "unconnected");
  ASSERT_NE(unconnected, nullptr);
  EXPECT_EQ(unconnected->subject, "odom -> base_footprint");
  EXPECT_NE(unconnected->remedy.find("'base_footprint' to 'base'"), std::string::npos);

  LinkMotion connected(vehicle_, needed_, options_);
  Drive(&connected, kStart, 400);
  for (int i = 0; i < 400; ++i)
    connected.Ingest(Transform("odom", "trailer", kStart + i * kPeriod, BodyPose(0.01 * i)), false);
  connected.Finish();
  EXPECT_EQ(FindKind(connected.MotionFindings("odom"), "unconnected"), nullptr);
}

TEST_F(LinkMotionTest, WhatALeaderDoesIsNotSaidOfItsFollowersToo) {
  LinkMotion links(vehicle_, needed_, options_);
  for (int i = 0; i < 400; ++i)
    links.Ingest(Joints(kStart + i * kPeriod, Travel(0.01 * i) + (i == 200 ? 0.02 : 0)));
  links.Finish();
  std::string subjects;
  for (const Finding& finding : links.MotionFindings("base")) subjects += finding.subject + ";";
  EXPECT_EQ(subjects, "base -> strut;");
}

TEST_F(LinkMotionTest, APositionThatNoJointCanHaveIsLeftOut) {
  LinkMotion links(vehicle_, needed_, options_);
  links.Ingest(Joints(kStart, 1e300));
  const std::vector<std::string> sentences = links.warnings().Sentences();
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_TRUE(Says(sentences, "1e+300")) << sentences[0];
}

TEST_F(LinkMotionTest, FramesWithoutACommonRootAreNamedWithTheOption) {
  for (const bool is_node : {false, true}) {
    options_.is_node = is_node;
    LinkMotion links(vehicle_, needed_, options_);
    links.Ingest(Transform("odom", "base", kStart, Pose()), false);
    links.Ingest(Transform("lab", "strut", kStart, Pose()), false);
    const std::vector<std::string> missing = links.Missing();
    EXPECT_TRUE(Says(missing, "'carrier' is below 'lab', 'arm' and 1 more are below 'odom'"));
    EXPECT_TRUE(Says(missing, is_node ? "~world_frame: lab or odom" : "--world-frame lab or odom"));
  }
}

// A joint whose limits exclude zero is not held outside of them.
TEST(LinkMotion, HeldJointsStayInsideTheirLimits) {
  VehicleModel vehicle = MakeVehicle();
  vehicle.joints[0].lower = 0.1;
  vehicle.joints[0].upper = 0.4;
  LinkMotionOptions options;
  options.held_joints = {"travel"};
  LinkMotion links(vehicle, {"strut"}, options);
  links.Ingest(Transform("odom", "base", kStart, Pose()), false);
  links.Finish();
  EXPECT_EQ(links.Evaluate("strut", kStart).X.p, Eigen::Vector3d(0, 0, 0.1));
}

}  // namespace
}  // namespace cosserat_cable
