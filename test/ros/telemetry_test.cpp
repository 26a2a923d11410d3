#include "cosserat_cable/ros/telemetry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cosserat_cable {
namespace {

// A reference link that turns and accelerates, and an apex that swings in the world.
Motion Reference(double t) {
  Motion motion;
  motion.X.p = {14 * t, 0.3 * t * t, 0.02 * std::sin(30 * t)};
  motion.v = {14, 0.6 * t, 0.6 * std::cos(30 * t)};
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 2) / 3;
  motion.X.q = Eigen::AngleAxisd(0.2 * std::sin(4 * t), axis);
  motion.omega = 0.8 * std::cos(4 * t) * axis;  // about a fixed axis: the same in both frames
  return motion;
}

CableReport Report(double t) {
  CableReport report;
  report.apex = {14 * t + 0.1 * std::sin(20 * t), 1, 0.5 * std::cos(t)};
  report.apex_velocity = {14 + 2 * std::cos(20 * t), 0, -0.5 * std::sin(t)};
  report.force_a = report.moment_a = report.force_b = report.moment_b = Eigen::Vector3d(1, 2, 3);
  return report;
}

TEST(TelemetryTest, VelocityIsThePositionsDerivative) {
  constexpr double h = 1e-5;
  // Central differences of motions with frequencies up to 30 rad/s: h^2/6 * 30^3 * 0.1 m.
  constexpr double kTolerance = 1e-7;
  for (const double t : {0.0, 0.3, 1.7}) {
    const Eigen::Vector3d rest(0.1, 0.2, 0.3);
    const ApexTelemetry now = MakeTelemetry(Report(t), Reference(t), rest, 1);
    const ApexTelemetry before = MakeTelemetry(Report(t - h), Reference(t - h), rest, 1);
    const ApexTelemetry after = MakeTelemetry(Report(t + h), Reference(t + h), rest, 1);
    EXPECT_NEAR(now.velocity_x, (after.position_x - before.position_x) / (2 * h), kTolerance);
    EXPECT_NEAR(now.velocity_y, (after.position_y - before.position_y) / (2 * h), kTolerance);
    EXPECT_NEAR(now.velocity_z, (after.position_z - before.position_z) / (2 * h), kTolerance);
    EXPECT_DOUBLE_EQ(now.displacement_x, now.position_x - 0.1);
  }
}

TEST(TelemetryTest, ForcesTurnIntoTheReferenceLink) {
  Motion reference;
  reference.X.q = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  const ApexTelemetry m = MakeTelemetry(Report(0), reference, Eigen::Vector3d::Zero(), 1);
  constexpr double kRounding = 1e-15;
  EXPECT_NEAR(m.force_a_x, 2, kRounding);
  EXPECT_NEAR(m.force_a_y, -1, kRounding);
  EXPECT_NEAR(m.moment_b_z, 3, kRounding);
}

TEST(TelemetryTest, OnlyClearanceMayBeInfinite) {
  ApexTelemetry message;
  message.clearance = INFINITY;
  EXPECT_TRUE(IsValid(message));
  message.clearance = NAN;
  EXPECT_FALSE(IsValid(message));
  message.clearance = 0;
  message.tension = INFINITY;
  EXPECT_FALSE(IsValid(message));
}

}  // namespace
}  // namespace cosserat_cable
