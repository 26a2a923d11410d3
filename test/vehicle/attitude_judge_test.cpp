#include "cosserat_cable/vehicle/attitude_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace cosserat_cable {
namespace {

constexpr double kMaxGap = 0.25;  // [s]

struct Angles {
  double roll, pitch, yaw;
};

Findings Judged(double rate, double seconds, const std::function<Angles(double)>& angles) {
  AttitudeJudge judge(kMaxGap);
  for (int i = 0; i <= static_cast<int>(rate * seconds); ++i) {
    const double t = i / rate;
    const Angles a = angles(t);
    judge.Add(100'000'000'000 + std::llround(1e9 * t),
              Eigen::AngleAxisd(a.yaw, Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(a.pitch, Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(a.roll, Eigen::Vector3d::UnitX()));
  }
  return judge.Report("odom -> base_link", "/tf");
}

// A vehicle that sways, steers and drives a curve [deg].
Angles Ride(double t) {
  return {2 * std::sin(2 * M_PI * 1.2 * t), 1.5 * std::sin(2 * M_PI * 1.7 * t + 1),
          20 * t + 10 * std::sin(0.5 * t)};
}

TEST(AttitudeJudge, VehiclesAreFine) {
  for (const double rate : {20.0, 100.0, 500.0}) {
    const auto in = [](const Angles& a, double unit) {
      return Angles{unit * a.roll, unit * a.pitch, unit * a.yaw};
    };
    EXPECT_TRUE(Judged(rate, 20, [&](double t) { return in(Ride(t), M_PI / 180); }).empty());
    // A motorcycle in a slalom, a robot that spins on the spot, a frame whose z axis points down.
    EXPECT_TRUE(Judged(rate, 20, [](double t) {
                  return Angles{0.8 * std::sin(2 * t), 0, t};
                }).empty());
    EXPECT_TRUE(Judged(rate, 20, [](double t) { return Angles{0, 0, 4 * t}; }).empty());
    EXPECT_TRUE(Judged(rate, 20, [&](double t) {
                  Angles a = in(Ride(t), M_PI / 180);
                  a.roll += M_PI;
                  return a;
                }).empty());
    // One that rolls over.
    EXPECT_TRUE(Judged(rate, 20, [](double t) {
                  const double u = std::min(std::max(t - 5, 0.0), 2.0) / 2;
                  return Angles{2 * M_PI * u, 0, 0};
                }).empty());
    EXPECT_TRUE(Judged(rate, 20, [](double) { return Angles{0, 0, 1}; }).empty());
  }
}

TEST(AttitudeJudge, DegreesForRadiansAreAskedAbout) {
  for (const double rate : {20.0, 100.0, 500.0}) {
    const std::vector<std::function<Angles(double)>> wrong = {
        Ride,
        [](double t) {
          return Angles{Ride(t).roll, 0, 0};
        },
        [](double t) {
          return Angles{0, Ride(t).pitch, 0};
        },
        [](double t) {
          return Angles{0, 0, Ride(t).yaw};
        },
        [](double t) {
          return Angles{0.7 * Ride(t).roll, 0, 0.01 * t};
        },
        // Slowly, over bumps.
        [](double t) {
          return Angles{2 * std::sin(t), 0, 0};
        }};
    for (std::size_t i = 0; i < wrong.size(); ++i) {
      const Findings findings = Judged(rate, 20, wrong[i]);
      ASSERT_EQ(findings.size(), 1u) << i << " at " << rate;
      EXPECT_EQ(findings[0].kind, "degrees");
      EXPECT_EQ(findings[0].subject, "odom -> base_link");
      EXPECT_NE(findings[0].remedy.find("in degrees"), std::string::npos);
      EXPECT_GT(findings[0].worst, 0);
    }
  }
}

}  // namespace
}  // namespace cosserat_cable
