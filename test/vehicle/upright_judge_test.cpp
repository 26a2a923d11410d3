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

// Upright up to `from` [s], and lying from there to `to`.
Findings Lying(double from, double to, double roll) {
  UprightJudge judge(kDown);
  for (int i = 0; i <= 1000; ++i) {
    const bool lies = i >= 100 * from && i <= 100 * to;
    judge.Add(1'000'000'000 + i * std::int64_t{10'000'000},
              Eigen::Quaterniond(Eigen::AngleAxisd(lies ? roll : 0.1, Eigen::Vector3d::UnitX())));
  }
  return judge.Report("base_link", "odom");
}

TEST(UprightJudge, OneThatLiesFromSomeTimeOnIsToldWithThatTime) {
  const Findings later = Lying(0.5, 10, M_PI / 2);
  ASSERT_EQ(later.size(), 1u);
  EXPECT_EQ(later[0].kind, "on_its_side");
  EXPECT_EQ(later[0].first, 1'500'000'000);
  EXPECT_NE(
      later[0].what.find("lies on its side from 1.500 s to the end, and stands upright before"),
      std::string::npos)
      << later[0].what;
  const Findings at_first = Lying(0, 8, M_PI);
  ASSERT_EQ(at_first.size(), 1u);
  EXPECT_NE(at_first[0].what.find("from 1.000 s to 9.000 s, and stands upright behind"),
            std::string::npos)
      << at_first[0].what;
  // Rolled over at the end.
  EXPECT_TRUE(Lying(8, 10, M_PI / 2).empty());
}

TEST(UprightJudge, AnglesInDegreesAreAskedAboutWhereNoAxisIsOff) {
  EXPECT_NE(Judged(kDown, 2.0, 0.1)[0].remedy.find("in degrees where radians are meant"),
            std::string::npos);
  EXPECT_EQ(Judged(kDown, M_PI, 0.1)[0].remedy.find("in degrees"), std::string::npos);
  EXPECT_EQ(Judged(kDown, M_PI / 2, 0.1)[0].remedy.find("in degrees"), std::string::npos);
}

}  // namespace
}  // namespace cosserat_cable
