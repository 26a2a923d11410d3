#include "cosserat_cable/vehicle/recording_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace cosserat_cable {
namespace {

constexpr double kMaxGap = 0.25;
constexpr std::int64_t kStart = 100'000'000'000;  // [ns]
constexpr std::int64_t kPeriod = 20'000'000;

VehicleModel MakeVehicle() {
  VehicleModel vehicle;
  vehicle.root = "base_link";
  vehicle.links = {"base_link", "strut", "mast"};
  JointModel travel, mount;
  travel.name = "travel";
  travel.parent = mount.parent = "base_link";
  travel.child = "strut";
  travel.type = JointModel::Type::kPrismatic;
  mount.name = "mount";
  mount.child = "mast";
  mount.X_PJ.p = {0, 0, 1};
  vehicle.joints = {travel, mount};
  return vehicle;
}

Pose At(double x) {
  Pose pose;
  pose.p.x() = x;
  return pose;
}

class RecordingJudgeTest : public testing::Test {
 protected:
  // 10 s of an edge at 50 Hz.
  template <class Position>
  void Drive(const char* parent, const char* child, const Position& position) {
    RecordingJudge::Edge* edge = judge_.At(parent, child);
    edge->topic = "/tf";
    for (int i = 0; i <= 500; ++i) judge_.AddMotion(edge, kStart + i * kPeriod, At(position(i)));
  }

  VehicleModel vehicle_ = MakeVehicle();
  RecordingJudge judge_{vehicle_, kMaxGap};
};

double Rolls(int i) { return 0.04 * i; }
double IsCorrected(int i) { return i < 250 ? 7 : 7.1; }

TEST_F(RecordingJudgeTest, TheFrameBelowACorrectedOneIsInertial) {
  Drive("odom", "base_link", Rolls);
  Drive("map", "odom", IsCorrected);
  const RecordingJudge::Way way = {"base_link", "odom", "map"};
  EXPECT_EQ(judge_.SmoothFrame(way), "odom");
  const Findings findings = judge_.Report(way, "odom");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "jump");
  EXPECT_EQ(findings[0].subject, "map -> odom");
  EXPECT_EQ(findings[0].worst, kStart + 250 * kPeriod);
  EXPECT_NE(judge_.Report(way, "map")[0].remedy.find("--world-frame odom"), std::string::npos);
}

TEST_F(RecordingJudgeTest, CorrectionsOfAVehicleThatStandsStillAreToldToo) {
  Drive("odom", "base_link", [](int) { return 1.0; });
  Drive("map", "odom", [](int i) { return 7 + 0.004 * (i / 100); });
  const RecordingJudge::Way way = {"base_link", "odom", "map"};
  const Findings findings = judge_.Report(way, judge_.SmoothFrame(way));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "jump");
  EXPECT_EQ(findings[0].subject, "map -> odom");
  EXPECT_NE(findings[0].remedy.find("--world-frame odom"), std::string::npos);
}

TEST_F(RecordingJudgeTest, ManySmallCorrectionsAreToldToo) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> which(-1, 1);
  double x = 7;
  Drive("odom", "base_link", Rolls);
  Drive("map", "odom", [&](int i) { return x += i % 5 == 0 ? 0.004 * which(random) : 0; });
  const RecordingJudge::Way way = {"base_link", "odom", "map"};
  EXPECT_EQ(judge_.SmoothFrame(way), "odom");
  const Findings findings = judge_.Report(way, "odom");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "jump");
  EXPECT_NEAR(findings[0].size, 0.004, 1e-6);
}

TEST_F(RecordingJudgeTest, CorrectionsThatAreFilteredAreToldToo) {
  // 50 mm within 0.1 to 0.8 s, at a constant speed, or set in motion and stopped gently.
  for (const double seconds : {0.1, 0.2, 0.5, 0.8}) {
    for (const bool gently : {false, true}) {
      RecordingJudge judge(vehicle_, kMaxGap);
      for (int i = 0; i <= 500; ++i) {
        const double u = std::clamp((0.02 * i - 5) / seconds, 0.0, 1.0);
        const double part = gently ? u * u * (3 - 2 * u) : u;
        judge.AddMotion(judge.At("odom", "base_link"), kStart + i * kPeriod, At(Rolls(i)));
        judge.AddMotion(judge.At("map", "odom"), kStart + i * kPeriod, At(7 + 0.05 * part));
      }
      const RecordingJudge::Way way = {"base_link", "odom", "map"};
      EXPECT_EQ(judge.SmoothFrame(way), "odom") << seconds;
      const Findings findings = judge.Report(way, "odom");
      ASSERT_EQ(findings.size(), 1u) << seconds;
      EXPECT_EQ(findings[0].subject, "map -> odom");
      EXPECT_NEAR(static_cast<double>(findings[0].worst - kStart) * 1e-9, 5, 0.1);
      EXPECT_NEAR(findings[0].size, 0.05, 0.005);
      EXPECT_NE(judge.Report(way, "map")[0].remedy.find("--world-frame odom"), std::string::npos);
    }
  }
}

TEST_F(RecordingJudgeTest, NoiseOfALocalisationIsToldAsSuch) {
  // 20 times a second, white, or filtered so that a platform might move like that: the names of the
  // frames say that it does not.
  for (const double filter : {1.0, 0.3}) {
    for (const bool stands : {false, true}) {
      std::mt19937 random(11);
      std::normal_distribution<double> noise(0, 5e-3);
      RecordingJudge judge(vehicle_, kMaxGap);
      double x = 0, y = 0;
      for (int i = 0; i <= 500; ++i) {
        judge.AddMotion(judge.At("odom", "base_link"), kStart + i * kPeriod,
                        At(stands ? 0 : Rolls(i)));
        if (i % 5 < 2) continue;
        x += filter * (noise(random) - x);
        y += filter * (x - y);
        judge.AddMotion(judge.At("map", "odom"), kStart + i * kPeriod, At(7 + y));
      }
      const RecordingJudge::Way way = {"base_link", "odom", "map"};
      const Findings findings = judge.Report(way, judge.SmoothFrame(way));
      ASSERT_FALSE(findings.empty()) << filter << stands;
      EXPECT_EQ(findings[0].subject, "map -> odom");
      EXPECT_NE(findings[0].remedy.find("--world-frame"), std::string::npos);
      EXPECT_EQ(judge.SmoothFrame(way), stands ? "map" : "odom") << filter;
    }
  }
}

TEST_F(RecordingJudgeTest, PlatformsAreNotCorrected) {
  const std::vector<std::function<double(double)>> platforms = {
      [](double t) { return 0.5 * std::sin(t); },                  // a ship
      [](double t) { return 2e-3 * std::sin(2 * M_PI * 8 * t); },  // a train
      [](double t) { return 0.01 * std::sin(2 * M_PI * 3 * t); },  // a test rig
      [](double t) { return 1e-3 * t; },                           // drift
      [](double t) {                                               // a lift
        const double u = std::clamp((t - 3) / 4, 0.0, 1.0);
        return u * u * (3 - 2 * u);
      }};
  for (std::size_t k = 0; k < platforms.size(); ++k) {
    RecordingJudge judge(vehicle_, kMaxGap);
    for (int i = 0; i <= 500; ++i) {
      judge.AddMotion(judge.At("deck", "base_link"), kStart + i * kPeriod, At(Rolls(i)));
      judge.AddMotion(judge.At("earth", "deck"), kStart + i * kPeriod, At(platforms[k](0.02 * i)));
    }
    const RecordingJudge::Way way = {"base_link", "deck", "earth"};
    EXPECT_EQ(judge.SmoothFrame(way), "earth") << k;
    EXPECT_TRUE(judge.Report(way, "earth").empty()) << k;
  }
}

TEST_F(RecordingJudgeTest, WithoutJumpsTheTopmostFrameIsInertial) {
  Drive("odom", "base_link", Rolls);
  Drive("ship", "odom", [](int) { return 3.0; });
  Drive("earth", "ship", [](int i) { return 0.1 * i + 0.2 * std::sin(0.02 * i); });
  const RecordingJudge::Way way = {"base_link", "odom", "ship", "earth"};
  EXPECT_EQ(judge_.SmoothFrame(way), "earth");
  EXPECT_TRUE(judge_.Report(way, "earth").empty());
}

TEST_F(RecordingJudgeTest, TheMotionBelowAJumpIsKept) {
  // The attitude alone moves right above the vehicle; the way it goes is one edge higher.
  Drive("footprint", "base_link", [](int i) { return 0.01 * std::sin(0.1 * i); });
  Drive("odom", "footprint", Rolls);
  Drive("map", "odom", IsCorrected);
  EXPECT_EQ(judge_.SmoothFrame({"base_link", "footprint", "odom", "map"}), "odom");
}

TEST_F(RecordingJudgeTest, AVehicleThatJumpsItselfHasNoSmootherFrame) {
  Drive("map", "base_link", [](int i) { return Rolls(i) + (i < 250 ? 0 : 0.1); });
  const RecordingJudge::Way way = {"base_link", "map"};
  EXPECT_EQ(judge_.SmoothFrame(way), "map");
  const Findings findings = judge_.Report(way, "map");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "jump");
}

TEST_F(RecordingJudgeTest, PublishersThatDisagreeAreNamed) {
  RecordingJudge::Edge* edge = judge_.At("base_link", "strut");
  const int driver = judge_.Publisher("/driver"), zeros = judge_.Publisher("/zeros");
  for (int i = 0; i <= 500; ++i) {
    judge_.AddSaid(edge, driver, kStart + i * kPeriod, At(0.03 * std::sin(0.1 * i)));
    if (i % 5 == 0) judge_.AddSaid(edge, zeros, kStart + i * kPeriod + 1'000'000, At(0));
  }
  const Findings findings = judge_.Report({"base_link"}, "base_link");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "two_publishers");
  EXPECT_EQ(findings[0].subject, "joint 'travel'");
  EXPECT_NE(findings[0].what.find("/driver"), std::string::npos);
  EXPECT_NE(findings[0].what.find("/zeros"), std::string::npos);
  EXPECT_NEAR(findings[0].size, 0.03, 0.001);
}

TEST_F(RecordingJudgeTest, PublishersThatDisagreeAreToldWithoutTheirNames) {
  // As `rosbag filter` leaves them; and what is noisy, or vibrates, is one publisher's.
  RecordingJudge::Edge* edge = judge_.At("base_link", "strut");
  const int somebody = judge_.Publisher("somebody");
  for (int i = 0; i <= 500; ++i) {
    judge_.AddSaid(edge, somebody, kStart + i * kPeriod, At(0.03 * std::sin(0.1 * i)));
    judge_.AddSaid(edge, somebody, kStart + i * kPeriod + 6'000'000, At(0));
  }
  const Findings findings = judge_.Report({"base_link"}, "base_link");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "two_publishers");
  EXPECT_NE(findings[0].remedy.find("do two publishers disagree?"), std::string::npos);
  EXPECT_NEAR(findings[0].size, 0.03, 0.003);
}

TEST_F(RecordingJudgeTest, NoiseAndVibrationAreOnePublishers) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 0.02);
  RecordingJudge::Edge* noisy = judge_.At("base_link", "strut");
  RecordingJudge::Edge* shaken = judge_.At("odom", "base_link");
  const int somebody = judge_.Publisher("somebody");
  for (int i = 0; i <= 2000; ++i) {
    judge_.AddSaid(noisy, somebody, kStart + i * kPeriod, At(normal(random)));
    judge_.AddSaid(shaken, somebody, kStart + i * kPeriod, At(0.1 * std::sin(2.2 * i)));
  }
  EXPECT_TRUE(judge_.Report({"base_link"}, "base_link").empty());
}

TEST_F(RecordingJudgeTest, PublishersThatAgreeAreFine) {
  RecordingJudge::Edge* edge = judge_.At("base_link", "strut");
  const int fast = judge_.Publisher("/fast"), slow = judge_.Publisher("/slow");
  const auto travel = [](double i) { return At(0.03 * std::sin(0.1 * i)); };
  for (int i = 0; i <= 500; ++i) {
    judge_.AddSaid(edge, fast, kStart + i * kPeriod, travel(i));
    if (i % 5 == 0) judge_.AddSaid(edge, slow, kStart + i * kPeriod + 7'000'000, travel(i + 0.35));
  }
  EXPECT_TRUE(judge_.Report({"base_link"}, "base_link").empty());
}

TEST_F(RecordingJudgeTest, AnAttitudeInDegreesIsToldInsteadOfWhatComesOfIt) {
  for (int i = 0; i <= 500; ++i) {
    Pose pose = At(Rolls(i));
    pose.q = Eigen::AngleAxisd(2 * std::sin(0.15 * i), Eigen::Vector3d::UnitX());
    judge_.AddMotion(judge_.At("odom", "base_link"), kStart + i * kPeriod, pose);
    // A wheel under a parent that the URDF does not know.
    pose.q = Eigen::AngleAxisd(0.8 * i, Eigen::Vector3d::UnitY());
    pose.p.setZero();
    judge_.AddMotion(judge_.At("axle", "strut"), kStart + i * kPeriod, pose);
  }
  const Findings findings = judge_.Report({"base_link", "odom"}, "odom");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "degrees");
  EXPECT_EQ(findings[0].subject, "odom -> base_link");
}

TEST_F(RecordingJudgeTest, FixedTransformsThatContradictAreTold) {
  judge_.AddFixed("base_link", "mast", vehicle_.joints[1].X_PJ, "/tf_static");
  EXPECT_TRUE(judge_.Report({"base_link"}, "base_link").empty());
  judge_.AddFixed("base_link", "mast", At(0.05), "/tf_static");
  const Findings changes = judge_.Report({"base_link"}, "base_link");
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].kind, "static_changes");

  RecordingJudge other(vehicle_, kMaxGap);
  other.AddFixed("base_link", "mast", At(0.05), "/tf_static");
  const Findings differs = other.Report({"base_link"}, "base_link");
  ASSERT_EQ(differs.size(), 1u);
  EXPECT_EQ(differs[0].kind, "differs_from_urdf");
}

}  // namespace
}  // namespace cosserat_cable
