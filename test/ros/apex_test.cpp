#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cosserat_cable/ros/apex_gate.h"
#include "cosserat_cable/ros/apex_history.h"
#include "cosserat_cable/ros/conversions.h"

namespace cosserat_cable {
namespace {

TEST(ApexHistoryTest, MeasuresAlongTheLargestMotion) {
  ApexHistory history(500'000'000);
  EXPECT_EQ(history.PeakToPeak(), 0);
  const Eigen::Vector3d axis = Eigen::Vector3d(3, 0, 4) / 5;
  for (int i = 0; i < 2000; ++i) {
    const double amplitude = i < 1000 ? 0.010 : 0.002;
    history.Add(i * 1'000'000,
                Eigen::Vector3d(1, 2, 3) + amplitude * std::sin(2 * M_PI * 30 * 1e-3 * i) * axis);
    // 33 samples a period: the peak is missed by at most 1 - cos(pi/33).
    if (i == 900) {
      EXPECT_NEAR(history.PeakToPeak(), 0.020, 0.020 * 0.005);
    }
  }
  EXPECT_NEAR(history.PeakToPeak(), 0.004, 0.004 * 0.005);
}

std::vector<ApexTelemetry> Swing(double amplitude, double frequency, double rate, double seconds) {
  std::vector<ApexTelemetry> messages;
  for (int i = 0; i <= seconds * rate; ++i) {
    ApexTelemetry m;
    const double t = i / rate;
    m.header.stamp =
        ToRosTime(1'000'000'000'000 + static_cast<std::int64_t>(std::llround(1e9 * t)));
    m.position_y = 5 + amplitude * std::sin(2 * M_PI * frequency * t);
    m.velocity_y = 2 * M_PI * frequency * amplitude * std::cos(2 * M_PI * frequency * t);
    m.clearance = 0.01 + 0.001 * std::cos(t);
    messages.push_back(m);
  }
  return messages;
}

TEST(ApexGateTest, PeaksBetweenSamplesAreMet) {
  // 200 Hz on 34 Hz: the highest sample alone may be 14 % low. A cubic over an angle of 1.07 rad is
  // off by at most 1.07^4 / 384 of the amplitude.
  const auto messages = Swing(0.002, 34, 200, 1);
  ApexBounds bounds;
  bounds.axis = 'y';
  bounds.start = 0.45;
  bounds.end = 0.55;
  bounds.peak_to_peak_min = 0.004 * 0.996;
  bounds.peak_to_peak_max = 0.004 * 1.004;
  EXPECT_TRUE(Judge(messages, {}, bounds).violations.empty());
}

TEST(ApexGateTest, EachBoundCanFail) {
  const auto messages = Swing(0.002, 10, 200, 2);
  const auto violations = [&](auto set, const std::vector<ApexTelemetry>& other = {}) {
    ApexBounds bounds;
    set(&bounds);
    return Judge(messages, other, bounds).violations.size();
  };
  EXPECT_EQ(violations([](ApexBounds* b) { b->peak_to_peak_min = 0.005; }), 1u);
  EXPECT_EQ(violations([](ApexBounds* b) { b->peak_to_peak_max = 0.003; }), 1u);
  EXPECT_EQ(violations([](ApexBounds* b) { b->axis = 'x', b->peak_to_peak_max = 0.003; }), 0u);
  EXPECT_EQ(violations([](ApexBounds* b) { b->min_clearance = 0.02; }), 1u);
  EXPECT_EQ(violations([](ApexBounds* b) { b->max_interval = 0.004; }), 1u);
  EXPECT_EQ(violations([](ApexBounds* b) { b->start = 3; }), 1u);
  EXPECT_EQ(violations([](ApexBounds* b) { b->end = 1.9, b->max_interval = 0.006; }), 0u);
  EXPECT_EQ(violations([](ApexBounds* b) { b->end = 2.1, b->max_interval = 0.006; }), 1u)
      << "the run ended within the window";
  const auto rms = [](ApexBounds* b) { b->max_rms_difference = 1e-4; };
  EXPECT_EQ(violations(rms), 1u) << "nothing to compare with";
  EXPECT_EQ(violations(rms, messages), 0u);
  EXPECT_EQ(violations(rms, Swing(0.003, 10, 200, 2)), 1u);
  EXPECT_EQ(violations(rms, Swing(0.002, 10, 200, 1)), 1u) << "half of the stamps are missing";
}

// As of a cable from which all bodies are out of reach, or that has none.
std::vector<ApexTelemetry> FarFromBodies(std::uint32_t bodies) {
  std::vector<ApexTelemetry> messages = Swing(0.002, 10, 200, 2);
  for (ApexTelemetry& m : messages) {
    m.clearance = INFINITY;
    m.bodies = bodies;
  }
  return messages;
}

TEST(ApexGateTest, NothingIsNotClearOfNothing) {
  const auto violations = [](std::uint32_t bodies, auto set) {
    ApexBounds bounds;
    set(&bounds);
    return Judge(FarFromBodies(bodies), {}, bounds).violations;
  };
  for (const auto& set :
       std::vector<void (*)(ApexBounds*)>{[](ApexBounds* b) { b->min_clearance = 0.005; },
                                          [](ApexBounds* b) { b->max_penetration = 0.001; },
                                          [](ApexBounds* b) { b->max_contact_force = 1; }}) {
    EXPECT_TRUE(violations(1, set).empty()) << "a body is there, out of reach";
    ASSERT_EQ(violations(0, set).size(), 1u);
    EXPECT_NE(violations(0, set)[0].find("nothing to be clear of"), std::string::npos);
  }
  EXPECT_TRUE(violations(0, [](ApexBounds* b) { b->peak_to_peak_max = 1; }).empty());
}

TEST(ApexGateTest, WhatIsNotJudgedDoesNotPass) {
  const auto messages = Swing(0.002, 10, 200, 2);
  ApexBounds bounds;
  EXPECT_EQ(Judge(messages, {}, bounds).violations.size(), 1u) << "no bound";
  bounds.peak_to_peak_max = 1;
  EXPECT_TRUE(Judge(messages, {}, bounds).violations.empty());
  bounds.end = 18;
  ASSERT_EQ(Judge(messages, {}, bounds).violations.size(), 1u);
  EXPECT_NE(Judge(messages, {}, bounds).violations[0].find("the telemetry ends at 2.000 s"),
            std::string::npos);
}

TEST(ApexGateTest, TelemetryThatIsNotFiniteDoesNotPass) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  ApexBounds bounds;
  bounds.peak_to_peak_max = 1;
  bounds.max_penetration = 1;
  bounds.max_curvature = 100;
  bounds.max_contact_force = 100;
  auto good = Swing(0.002, 10, 200, 2);
  for (ApexTelemetry& m : good) m.bodies = 1;
  EXPECT_TRUE(Judge(good, {}, bounds).violations.empty());
  const auto with = [&](auto set, double value) {
    auto messages = good;
    set(&messages[100]) = value;
    return Judge(messages, {}, bounds).violations;
  };
  const auto refused = [](const std::vector<std::string>& violations) {
    return violations.size() == 1 && violations[0].find("1 of 401") != std::string::npos;
  };
  for (const double value : {kNan, -kInf}) {
    EXPECT_TRUE(refused(with([](auto* m) -> double& { return m->position_y; }, value)));
    EXPECT_TRUE(refused(with([](auto* m) -> double& { return m->velocity_x; }, value)));
    EXPECT_TRUE(refused(with([](auto* m) -> double& { return m->curvature_max; }, value)));
    EXPECT_TRUE(refused(with([](auto* m) -> double& { return m->contact_force; }, value)));
    EXPECT_TRUE(refused(with([](auto* m) -> double& { return m->clearance; }, value)));
  }
  // Nothing within reach.
  EXPECT_TRUE(with([](auto* m) -> double& { return m->clearance; }, kInf).empty());
}

TEST(ApexGateTest, MissingBagIsAProblem) {
  Problems problems;
  EXPECT_TRUE(ReadApexTelemetry("/no/such.bag", "c", &problems).empty());
  EXPECT_FALSE(problems.empty());
}

}  // namespace
}  // namespace cosserat_cable
