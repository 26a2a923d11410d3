#include <tf2/buffer_core.h>

#include "link_motion_cases.h"

namespace cosserat_cable {
namespace {

using testing::BodyPose;
using testing::Drive;
using testing::Joints;
using testing::kPeriod;
using testing::kStart;
using testing::LinkMotionTest;
using testing::MakeVehicle;
using testing::Says;
using testing::Transform;
using testing::Travel;

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
  links.Finish();
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
