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
  pace.Advanced(0.02, 0.005);
  pace.Advanced(0.01, 0.001);
  pace.Delivered(0.03, kStart);
  pace.Delivered(0.01, kStart);
  const Pace::Report report = pace.Take();
  EXPECT_DOUBLE_EQ(report.real_time_factor, 5);
  EXPECT_DOUBLE_EQ(report.worst_latency, 0.03);
  EXPECT_DOUBLE_EQ(pace.Take().worst_latency, 0);
}

}  // namespace
}  // namespace cosserat_cable
