// Quaternions written w first are named before anything is fitted; good ones never.
#include <gtest/gtest.h>

#include <cmath>

#include "cosserat_cable/measurement/measurement_set.h"
#include "measurement/rigs.h"

namespace cosserat_cable {
namespace {

using testing::ChannelAt;

struct Looks {
  std::string problems, warnings;
};

/// `stiffness`: EI and GJ [N m^2].
Looks Look(const Experiment& experiment, const std::string& stiffness = "0.3") {
  MeasurementSet set;
  const std::string text =
      "length: 0.25\ndiameter: 0.006\nmass_per_length: 0.05\nEI: " + stiffness +
      "\nGJ: " + stiffness + "\neta_EI: null\neta_GJ: null\nuncertain: [EI, eta_EI]\n";
  Problems problems, warnings;
  MapReader map(YamlValue::Root("set", YAML::Load(text), &problems));
  set.cable = ReadCableKeys(&map);
  set.cable_mark = map.mark();
  set.experiments = {experiment};
  CheckPlausibility(set, &problems, &warnings);
  return {problems.ToString(), warnings.ToString()};
}

/// A stiff cable, straight but for 1 %, out of a clamp at `position` with the quaternion qx, qy,
/// qz, qw: its tip and middle are on the clamp's z axis, which the caller gives.
Experiment Straight(const Eigen::Vector4d& q, const Eigen::Vector3d& along, int channels = 6) {
  Experiment experiment;
  experiment.name = "straight";
  experiment.record.file = "straight.csv";
  experiment.a.pose.p = {1, -2, 0.5};
  experiment.a.pose.q.coeffs() = q;
  experiment.a.mark = {"set", 12, "a"};
  experiment.b.kind = EndCondition::Kind::kFree;
  constexpr int kSamples = 20;
  experiment.record.values.resize(kSamples, channels);
  for (int i = 0; i < kSamples; ++i) experiment.record.t.push_back(0.01 * i);
  for (int c = 0; c < channels; ++c) {
    const double s = c < 3 ? 0.25 : 0.125;
    experiment.channels.push_back(ChannelAt(s, Quantity::kPosition, c % 3));
    experiment.channels.back().column = "channel_" + std::to_string(c);
    for (int i = 0; i < kSamples; ++i)
      experiment.record.values(i, c) =
          experiment.a.pose.p[c % 3] + s * along[c % 3] + 1e-4 * (i % 3);
  }
  return experiment;
}

// A quarter turn about x takes z to -y. Its components qw, qx, qy, qz, read as qx, qy, qz, qw, are
// half a turn about (1, 1, 0), which takes z to -z.
const Eigen::Vector4d kQuarter{std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
const Eigen::Vector4d kQuarterWFirst{std::sqrt(0.5), std::sqrt(0.5), 0, 0};
const Eigen::Vector3d kThere{0, -1, 0};

TEST(AttitudeCheck, AGoodPoseIsNotNamed) {
  const Looks looks = Look(Straight(kQuarter, kThere));
  EXPECT_EQ(looks.problems, "");
  EXPECT_EQ(looks.warnings.find("w first"), std::string::npos) << looks.warnings;
}

TEST(AttitudeCheck, APoseWithWFirstIsNamed) {
  const Looks looks = Look(Straight(kQuarterWFirst, kThere));
  EXPECT_NE(looks.problems.find("set:12: pose: got a quaternion with which the cable at rest is"),
            std::string::npos)
      << looks.problems;
  EXPECT_NE(looks.problems.find("looks like w first (qw, qx, qy, qz), expected qx, qy, qz, qw"),
            std::string::npos)
      << looks.problems;
}

TEST(AttitudeCheck, AMotionWithWFirstIsNamed) {
  Experiment experiment = Straight(kQuarterWFirst, kThere);
  ClampMotion motion;
  motion.file = "clamp_a.csv";
  for (int i = 0; i < 20; ++i) {
    motion.t.push_back(0.01 * i);
    motion.poses.push_back(experiment.a.pose);
  }
  experiment.a.motion = motion;
  experiment.a.pose = Pose();
  const Looks looks = Look(experiment);
  EXPECT_NE(looks.problems.find("set:12: motion: clamp_a.csv: got quaternions with which"),
            std::string::npos)
      << looks.problems;
}

TEST(AttitudeCheck, AHeldPointTellsWhereTheRecordShowsTooLittle) {
  // In x alone, nothing is seen of a cable along y.
  Experiment experiment = Straight(kQuarterWFirst, kThere, 1);
  EXPECT_EQ(Look(experiment).problems, "");
  experiment.start.kind = StartCondition::Kind::kHeld;
  experiment.start.held.s = 0.25;
  experiment.start.held.position_W = experiment.a.pose.p + Eigen::Vector3d(0, -0.248, 0.02);
  const Looks looks = Look(experiment);
  EXPECT_NE(looks.problems.find("looks like w first"), std::string::npos) << looks.problems;
}

TEST(AttitudeCheck, OneCoordinateIsAWarning) {
  Experiment experiment = Straight(kQuarterWFirst, kThere, 2);
  experiment.channels.erase(experiment.channels.begin());
  experiment.record.values = experiment.record.values.rightCols(1).eval();
  const Looks looks = Look(experiment);
  EXPECT_EQ(looks.problems, "");
  EXPECT_NE(looks.warnings.find("looks like w first"), std::string::npos) << looks.warnings;
}

TEST(AttitudeCheck, ATurnedSignIsNoQuaternion) {
  // Hanging, with w first it would stand; so it seems to where z was recorded downwards.
  Experiment experiment = Straight({1, 0, 0, 0}, {0, 0, -1});
  experiment.a.pose.p.setZero();
  for (int c = 0; c < 6; ++c) {
    experiment.record.values.col(c).array() -= Eigen::Vector3d(1, -2, 0.5)[c % 3];
    if (c % 3 == 2) experiment.record.values.col(c) *= -1;
  }
  const Looks looks = Look(experiment);
  EXPECT_EQ((looks.problems + looks.warnings).find("w first"), std::string::npos) << looks.problems;
}

TEST(AttitudeCheck, ASoftCableThatHangsFromALevelClampIsNotNamed) {
  // Half a turn about (0, 1, 1) takes z to y, and reads with w first as one that takes it to -z:
  // where a soft cable hangs.
  Experiment experiment = Straight({0, std::sqrt(0.5), std::sqrt(0.5), 0}, {0, 0.25, -0.9});
  const Looks looks = Look(experiment, "5.0e-5");
  EXPECT_EQ((looks.problems + looks.warnings).find("w first"), std::string::npos) << looks.problems;
}

}  // namespace
}  // namespace cosserat_cable
