#include "../../src/ros/pace.h"

#include <gtest/gtest.h>

namespace cosserat_cable {
namespace {

using std::chrono::milliseconds;
const Pace::Clock::time_point kStart{};

TEST(PaceTest, AShortDelayIsForgiven) {
  Pace pace;
  for (int ms = 0; ms < 1500; ms += 5) pace.Delivered(1.0, kStart + milliseconds(ms));
  EXPECT_FALSE(pace.behind());
  pace.Delivered(0.05, kStart + milliseconds(1500));
  for (int ms = 1505; ms < 3000; ms += 5) pace.Delivered(1.0, kStart + milliseconds(ms));
  EXPECT_FALSE(pace.behind());
}

TEST(PaceTest, ALongDelayIsNotUntilItIsCaughtUpWith) {
  Pace pace;
  for (int ms = 0; ms < 2500; ms += 5) pace.Delivered(0.6, kStart + milliseconds(ms));
  EXPECT_TRUE(pace.behind());
  pace.Delivered(0.3, kStart + milliseconds(2500));
  EXPECT_TRUE(pace.behind());
  pace.Delivered(0.1, kStart + milliseconds(2505));
  EXPECT_FALSE(pace.behind());
}

TEST(PaceTest, ReportsWhatHappenedSinceTheLastReport) {
  Pace pace;
  // 20 ms in 5 ms, a rest, 10 ms in 1 ms; what came before the start is not known.
  pace.Begin(0, kStart);
  pace.Reached(1'000'000'000, kStart + milliseconds(700));
  pace.Reached(1'020'000'000, kStart + milliseconds(705));
  pace.Begin(1'020'000'000, kStart + milliseconds(800));
  pace.Reached(1'030'000'000, kStart + milliseconds(801));
  pace.Delivered(0.03, kStart);
  pace.Delivered(0.01, kStart);
  const Pace::Report report = pace.Take();
  EXPECT_DOUBLE_EQ(report.real_time_factor, 5);
  EXPECT_DOUBLE_EQ(report.worst_latency, 0.03);
  EXPECT_DOUBLE_EQ(pace.Take().worst_latency, 0);
}

}  // namespace
}  // namespace cosserat_cable
