// Two publishers of one edge that say different things.
#include "cosserat_cable/vehicle/publisher_judge.h"

#include <gtest/gtest.h>

namespace cosserat_cable {
namespace {

constexpr std::int64_t kInterval = 10'000'000;  // [ns]
constexpr int kSamples = 500;

/// As many publishers, each at 100 Hz with its own offset in time and value [m].
PublisherJudge Judged(const std::vector<double>& values) {
  PublisherJudge judge;
  const auto publishers = static_cast<int>(values.size());
  for (int i = 0; i < kSamples; ++i)
    for (int p = 0; p < publishers; ++p) {
      Pose pose;
      pose.p.x() = values[static_cast<std::size_t>(p)];
      judge.Add(p, kInterval * (1 + i) + kInterval * p / publishers, pose);
    }
  return judge;
}

TEST(PublisherJudgeTest, EachSampleThatDiffersCountsOnce) {
  // All samples but the first ones, which nothing stands beside.
  for (const std::vector<double>& values : {std::vector<double>{0, 0.1}, {0, 0.1, 0.2}}) {
    const std::uint64_t all = kSamples * values.size();
    const PublisherJudge::Conflict conflict = Judged(values).conflict();
    EXPECT_LE(conflict.count, all);
    EXPECT_GE(conflict.count, all - 3 * values.size());
    EXPECT_NEAR(conflict.translation, values.back(), 1e-12);
  }
}

TEST(PublisherJudgeTest, AWheelThatTurnsNearlyHalfATurnPerSampleIsNoTwoPublishers) {
  PublisherJudge judge;
  for (int i = 0; i < kSamples; ++i) {
    Pose pose;
    pose.q = Eigen::AngleAxisd(2.9 * i, Eigen::Vector3d::UnitY());
    judge.Add(0, kInterval * (1 + i), pose);
  }
  EXPECT_EQ(judge.two_courses().count, 0u);
}

TEST(PublisherJudgeTest, TwoThatAgreeAreFine) {
  EXPECT_EQ(Judged({0.1, 0.1}).conflict().count, 0u);
}

}  // namespace
}  // namespace cosserat_cable
