#include "cosserat_cable/vehicle/upright_judge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cosserat_cable {
namespace {

const Eigen::Vector3d kDown(0, 0, -9.81);

Findings Judged(const Eigen::Vector3d& gravity, double roll, double sways) {
  UprightJudge judge(gravity);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Quaterniond q_WR(
        Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(roll + sways * std::sin(0.2 * i), Eigen::Vector3d::UnitX()));
    judge.Add(1'000'000'000 + i * 10'000'000, q_WR);
  }
  return judge.Report("base_link", "odom");
}

TEST(UprightJudge, AVehicleThatStandsUprightIsFine) {
  EXPECT_TRUE(Judged(kDown, 0, 0.5).empty());
  EXPECT_TRUE(Judged(-kDown, M_PI, 0.5).empty());
  EXPECT_TRUE(Judged(Eigen::Vector3d::Zero(), M_PI, 0).empty());
  // It rolls over.
  EXPECT_TRUE(Judged(kDown, M_PI / 2, M_PI / 2).empty());
}

TEST(UprightJudge, OneThatIsUpsideDownAllTheTimeIsAskedAbout) {
  const Findings findings = Judged(kDown, M_PI, 0.1);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, "upside_down");
  EXPECT_NE(findings[0].what.find("gravity points out of its roof"), std::string::npos);
  EXPECT_NE(findings[0].remedy.find("--gravity 0,0,9.81"), std::string::npos);
  EXPECT_EQ(Judged(-kDown, 0, 0).size(), 1u);
  ASSERT_EQ(Judged(kDown, M_PI / 2, 0).size(), 1u);
  EXPECT_EQ(Judged(kDown, M_PI / 2, 0)[0].kind, "on_its_side");
}

}  // namespace
}  // namespace cosserat_cable
