#include "cosserat_cable/input/gravity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

TEST(Gravity, IsReadAsItIsWritten) {
  Problems problems;
  EXPECT_EQ(*ReadGravity("0,0,-9.81", &problems), Vector3d(0, 0, -9.81));
  EXPECT_EQ(*ReadGravity(" 1e-1, 0 ,9.81 ", &problems), Vector3d(0.1, 0, 9.81));
  EXPECT_EQ(*ReadGravity("0,0,0", &problems), Vector3d(0, 0, 0));
  EXPECT_TRUE(problems.empty()) << problems.ToString();
}

TEST(Gravity, WhatIsWrongIsSaid) {
  const struct {
    const char *text, *said;
  } kCases[] = {
      {"9.81", "got 1 number, expected three"},
      {"0,0", "got 2 numbers"},
      {"0,0,-9.81,0", "got 4 numbers"},
      {"0,0,nan", "got '0,0,nan'"},
      {"0,0,-inf", "got '0,0,-inf'"},
      {"0,0,g", "got '0,0,g'"},
      {"", "got ''"},
      {"0,,9.81", "got '0,,9.81'"},
      {"0 0 9.81", "got '0 0 9.81'"},
      {"0,0,981", "got 981 m/s^2"},
      {"0,0,-9.81e3", "got 9810 m/s^2"},
  };
  for (const auto& each : kCases) {
    Problems problems;
    EXPECT_FALSE(ReadGravity(std::string(each.text), &problems)) << each.text;
    EXPECT_NE(problems.ToString().find(each.said), std::string::npos) << problems.ToString();
    EXPECT_NE(problems.ToString().find("gravity"), std::string::npos);
  }
  Problems problems;
  EXPECT_FALSE(ReadGravity(std::vector<double>{0, 0, NAN}, &problems));
  EXPECT_FALSE(problems.empty());
}

TEST(Gravity, IsNamedByItsAxisAndFrame) {
  EXPECT_EQ(GravityText({0, 0, -9.81}, "odom"), "gravity 9.81 m/s^2 along -z of odom");
  EXPECT_EQ(GravityText({0, 0, 3.71}, "site"), "gravity 3.71 m/s^2 along +z of site");
  EXPECT_EQ(GravityText({9.81, 0, 0}, "base"), "gravity 9.81 m/s^2 along +x of base");
  EXPECT_EQ(GravityText({3, 0, 4}, "base"), "gravity 5 m/s^2 along (0.600, 0.000, 0.800) of base");
  EXPECT_EQ(GravityText({0, 0, 0}, "base"), "no gravity");
}

TEST(Gravity, FramesTellTheirVerticalByWholeWords) {
  for (const char* frame : {"ned", "odom_ned", "map/ned", "NED_origin", "base_link_frd",
                            "world-ned", "odom_z_down", "zdown"})
    EXPECT_EQ(VerticalAxisOf(frame), VerticalAxis::kDown) << frame;
  for (const char* frame : {"odom_enu", "flu", "map_z_up"})
    EXPECT_EQ(VerticalAxisOf(frame), VerticalAxis::kUp) << frame;
  for (const char* frame : {"odom", "planned_path", "turned", "nedlloyd", "ned_to_enu", ""})
    EXPECT_EQ(VerticalAxisOf(frame), VerticalAxis::kUnknown) << frame;
}

TEST(Gravity, ANameThatContradictsIsSaidWithTheOption) {
  const std::string hint = GravityHint({0, 0, -9.81}, "odom_ned");
  EXPECT_NE(hint.find("--gravity 0,0,9.81"), std::string::npos) << hint;
  EXPECT_EQ(GravityHint({0, 0, 9.81}, "odom_ned"), "");
  EXPECT_EQ(GravityHint({0, 0, -9.81}, "odom"), "");
  EXPECT_EQ(GravityHint({0, 0, 0}, "odom_ned"), "");
  EXPECT_NE(GravityHint({0, 0, 9.81}, "odom_enu").find("--gravity 0,0,-9.81"), std::string::npos);
}

// What an accelerometer feels at rest points up.
TEST(Gravity, AnAccelerometerThatContradictsIsSaidWithTheOption) {
  const Vector3d down_z(0, 0, -9.81);
  EXPECT_EQ(GravityHint(down_z, "odom", {0.4, -0.2, 9.75}, "/imu"), "");
  const std::string flipped = GravityHint(down_z, "odom", {0.4, -0.2, -9.75}, "/imu");
  EXPECT_NE(flipped.find("/imu"), std::string::npos) << flipped;
  EXPECT_NE(flipped.find("--gravity 0,0,9.81"), std::string::npos) << flipped;
  const std::string mars = GravityHint(down_z, "odom", {0, 0, 3.71}, "/imu");
  EXPECT_NE(mars.find("--gravity 0,0,-3.71"), std::string::npos) << mars;
  // Without gravity in it, or where there is to be none.
  EXPECT_EQ(GravityHint(down_z, "odom", {0.1, 0, 0.2}, "/imu"), "");
  EXPECT_EQ(GravityHint({0, 0, 0}, "odom", {0, 0, 9.81}, "/imu"), "");
}

TEST(Gravity, AnAccelerometerInAnotherUnitIsCalledSo) {
  const Vector3d down_z(0, 0, -9.81);
  const auto hint = [&](double size) {
    return GravityHint(down_z, "odom", size * Vector3d(0.04, -0.02, 0.999).normalized(), "/imu");
  };
  const std::vector<std::pair<double, std::string>> units = {
      {0.99, "in g?"},      {1.03, "in g?"},     {981, "in cm/s^2"}, {1000, "thousandths of g"},
      {9790, "in mm/s^2?"}, {32.2, "in ft/s^2?"}};
  for (const auto& [size, words] : units) {
    EXPECT_NE(hint(size).find(words), std::string::npos) << size << ": " << hint(size);
    EXPECT_EQ(hint(size).find("--gravity"), std::string::npos) << hint(size);
  }
  // The direction is off as well.
  EXPECT_NE(GravityHint(down_z, "odom", {0, 0, -1}, "/imu").find("--gravity 0,0,9.81"),
            std::string::npos);
  // Neither a unit nor a planet: no such gravity is advised.
  for (const double size : {2.5, 15.0, 120.0, 2048.0, 16384.0}) {
    EXPECT_NE(hint(size).find("is it raw, in another unit"), std::string::npos) << hint(size);
    EXPECT_EQ(hint(size).find("--gravity"), std::string::npos) << hint(size);
  }
  EXPECT_NE(GravityHint(down_z, "odom", {0, 0, -16384}, "/imu").find("--gravity 0,0,9.81"),
            std::string::npos);
  // Gravity was taken out, and the vehicle gathered speed.
  EXPECT_EQ(GravityHint(down_z, "odom", {0.98, 0, 0.1}, "/imu"), "");
}

}  // namespace
}  // namespace cosserat_cable
