#include "cosserat_cable/vehicle/clamp_judge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {
namespace {

constexpr std::int64_t kStep = 10'000'000;  // [ns]

Pose Turned(const Eigen::Vector3d& phi) { return {Eigen::Vector3d::Zero(), RotationExp(phi)}; }

TEST(ClampJudge, TellsTheRangeAndWhenItWasLargest) {
  ClampJudge judge("hose", 0.4, 0.01);
  for (int i = 0; i <= 400; ++i) {
    Pose b;
    b.p.x() = 0.385 - 0.035 * std::cos(M_PI * i / 100);
    judge.Add(10'000'000'000 + i * kStep, Pose(), b);
  }
  EXPECT_NEAR(judge.range().least, 0.35, 1e-12);
  EXPECT_NEAR(judge.range().most, 0.42, 1e-12);
  EXPECT_EQ(judge.range().most_at, 11'000'000'000);
  EXPECT_EQ(judge.Describe(),
            "350.0 to 420.0 mm apart (88 to 105 % of its length, most at 11.000 s)");
  const Findings findings = judge.Report();
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "clamps_too_far");
  EXPECT_EQ(findings[0].subject, "cable 'hose'");
  EXPECT_EQ(findings[0].worst, 11'000'000'000);
}

TEST(ClampJudge, SteeringAndSpringingIsFine) {
  ClampJudge judge("hose", 0.4, 0.01);
  // A cone, on which angular velocities add up, goes round and round.
  for (int i = 0; i < 10000; ++i) {
    const double t = 0.05 * i;
    Pose b = Turned({0.5 * std::sin(t), 0.5 * std::cos(t), 0});
    b.p.x() = 0.3;
    judge.Add(i * kStep, Pose(), b);
  }
  EXPECT_TRUE(judge.Report().empty());
  EXPECT_LT(judge.range().turn, 1.1);
}

TEST(ClampJudge, TurnsAddUp) {
  ClampJudge judge("lead", 0.4, 0.005);
  // 3.5 turns about an axis that is not quite steady, and half of them back.
  for (int i = 0; i <= 1500; ++i) {
    const double angle = 2 * M_PI * 3.5 * (i < 1000 ? i : 2000 - i) / 1000;
    judge.Add(i * kStep, Pose(), Turned({0, 0, angle}) * Turned({0.05 * std::sin(0.1 * i), 0, 0}));
  }
  const Findings findings = judge.Report();
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "clamps_turned");
  EXPECT_NEAR(findings[0].size, 7 * M_PI, 0.1);
}

}  // namespace
}  // namespace cosserat_cable
