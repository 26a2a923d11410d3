#include "cosserat_cable/vehicle/joint_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace cosserat_cable {
namespace {

constexpr double kMaxGap = 0.25;  // [s]
constexpr std::int64_t kStart = 1'000'000'000'000;
constexpr double kRate = 100;  // [Hz]

std::int64_t Stamp(int sample) {
  return kStart + static_cast<std::int64_t>(std::llround(sample / kRate * 1e9));
}

JointModel Joint(JointModel::Type type, double lower, double upper, double velocity) {
  JointModel joint;
  joint.name = "j";
  joint.type = type;
  joint.axis = Eigen::Vector3d::UnitZ();
  joint.lower = lower;
  joint.upper = upper;
  joint.velocity = velocity;
  joint.X_PJ.p = {0.1, 0.2, 0.3};
  return joint;
}

const JointModel kSteer = Joint(JointModel::Type::kRevolute, -0.6, 0.6, 5);
const JointModel kTravel = Joint(JointModel::Type::kPrismatic, -0.1, 0.1, 2);
const JointModel kWheel = Joint(JointModel::Type::kRevolute, -INFINITY, INFINITY, INFINITY);

Findings Found(const JointModel& joint, const std::function<double(double)>& position) {
  JointJudge judge(joint, kMaxGap);
  for (int i = 0; i <= 500; ++i) judge.Add(Stamp(i), position(i / kRate));
  return judge.Report("/joint_states");
}

TEST(JointJudge, MotionWithinTheLimitsIsFine) {
  EXPECT_TRUE(Found(kSteer, [](double t) { return 0.6 * std::sin(2 * t); }).empty());
  EXPECT_TRUE(Found(kWheel, [](double t) { return 100 * t; }).empty());
}

TEST(JointJudge, LimitsOfPositionAreTold) {
  const Findings findings =
      Found(kTravel, [](double t) { return 0.02 + 0.1 * std::sin(M_PI * t); });
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "joint_limit");
  EXPECT_EQ(findings[0].subject, "joint 'j'");
  EXPECT_NEAR(findings[0].size, 0.12, 1e-12);
  EXPECT_EQ(findings[0].limit, 0.1);
  EXPECT_EQ(findings[0].worst, Stamp(50));
}

TEST(JointJudge, DegreesAreRecognised) {
  for (const double degrees : {3.0, 30.0}) {
    const Findings findings = Found(kSteer, [&](double t) { return degrees * std::sin(0.1 * t); });
    ASSERT_FALSE(findings.empty());
    EXPECT_EQ(findings[0].kind, "degrees") << degrees;
    EXPECT_NE(findings[0].remedy.find("degrees"), std::string::npos);
  }
  // Too much for either unit.
  EXPECT_EQ(Found(kSteer, [](double t) { return 50 * std::sin(0.5 * t); })[0].kind, "joint_limit");
}

TEST(JointJudge, MillimetresAreRecognised) {
  EXPECT_EQ(Found(kTravel, [](double t) { return 40 * std::sin(t); })[0].kind, "millimetres");
}

TEST(JointJudge, LimitsOfVelocityAreTold) {
  const Findings findings = Found(kTravel, [](double t) { return 0.09 * std::sin(30 * t); });
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "joint_velocity");
  // The mean over 20 ms of 2.7 m/s at most.
  EXPECT_NEAR(findings[0].size, 2.7, 0.05);
}

TEST(JointJudge, OutliersAreNotTakenForDegrees) {
  const Findings findings = Found(kSteer, [](double t) {
    return std::abs(t - 2) < 0.001 ? -0.6 : 0.6;  // as fast as 60 rad/s, for one sample
  });
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "joint_velocity");
  EXPECT_EQ(findings[0].remedy.find("degrees"), std::string::npos);
}

TEST(JointJudge, EncoderStepsAreNoVelocity) {
  JointJudge judge(kTravel, kMaxGap);
  constexpr double kStep = 4e-3;  // 1 kHz: 4 m/s from one sample to the next
  for (int i = 0; i < 2000; ++i)
    judge.Add(kStart + i * 1'000'000, kStep * std::round(0.05 * std::sin(0.003 * i) / kStep));
  EXPECT_TRUE(judge.Report("").empty());
}

TEST(JointJudge, TurnsTooFastForTheirSamplesAreTold) {
  const Findings findings = Found(kWheel, [](double t) { return 400 * t; });
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "half_turn");
}

TEST(JointJudge, TransformsAreReadAsPositions) {
  for (const JointModel* joint : {&kSteer, &kTravel}) {
    const JointReading reading = ReadJoint(*joint, joint->Evaluate(0.07));
    EXPECT_NEAR(reading.position, 0.07, 1e-12);
    EXPECT_LT(reading.off_axis, 1e-12);
    EXPECT_LT(reading.off_turn, 1e-7);  // a square root near zero
  }
}

TEST(JointJudge, TransformsOffTheAxisAreTold) {
  JointJudge judge(kTravel, kMaxGap);
  for (int i = 0; i < 50; ++i) {
    Pose pose = kTravel.Evaluate(0.01);
    pose.p.x() += 0.02;
    judge.Add(Stamp(i), pose);
  }
  const Findings findings = judge.Report("/tf");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "off_axis");
  EXPECT_NEAR(findings[0].size, 0.02, 1e-12);
}

}  // namespace
}  // namespace cosserat_cable
