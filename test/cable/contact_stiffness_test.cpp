#include "cosserat_cable/cable/contact_stiffness.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cable/cable_cases.h"
#include "cosserat_cable/cable/cable_simulation.h"

namespace cosserat_cable {
namespace {

// A hydraulic hose, clamped on two brackets of one frame.
CableModel Hose() {
  CableModel hose = RoundCableModel(1.2, 0.030, 1.3, 25, 20, 0.05);
  hose.a.link = hose.b.link = "frame";
  const Eigen::Quaterniond along_x(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()));
  hose.a.X_LC = {{-0.6, 0, 0}, along_x};
  hose.b.X_LC = {{0.59, 0, 0}, along_x};
  hose.contact.stiffness = DefaultContactStiffness(hose);
  return hose;
}

// Values by a pocket calculator, rounded up to two digits.
TEST(ContactStiffness, FollowsFromWhatTheCableCanPressWith) {
  // 96 EI/L^2 = 1666.7 N, ten weights 153.0 N; pushed by 0.12 m it is 1.21396 m long, more than the
  // 1 % allowed: 4 EA 0.01 0.12/1.21396 = 1757.3 N. Over 0.75 mm: 4.77e6.
  EXPECT_DOUBLE_EQ(Hose().contact.stiffness, 4.8e6);
  CableModel hose = Hose();
  hose.b.link = "elsewhere";  // 1819.7 N
  EXPECT_DOUBLE_EQ(DefaultContactStiffness(hose), 2.5e6);
  // 1.5 N + 1.18 N over 0.125 mm.
  EXPECT_DOUBLE_EQ(DefaultContactStiffness(RoundCableModel(0.4, 0.005, 0.03, 2.5e-3, 2.5e-3, 1e-5)),
                   2.2e4);
}

TEST(ContactStiffness, StaysBetweenThatOfThinCablesAndTheSections) {
  // 0.28 N over 0.025 mm are 1.1e4 N/m.
  EXPECT_EQ(DefaultContactStiffness(RoundCableModel(0.5, 0.001, 0.005, 1e-4, 1e-4, 1e-6)),
            ContactLaw().stiffness);
  // Short and thick: 2.4e5 N over 0.5 mm, but E r = 64 EI/(pi d^4) r = 3.18e7 N/m.
  EXPECT_DOUBLE_EQ(DefaultContactStiffness(RoundCableModel(0.1, 0.020, 1, 25, 20, 0.05)), 3.2e7);
}

TEST(ContactStiffness, TellsWhatWouldDo) {
  CableModel hose = Hose();
  hose.contact.stiffness = 2e4;
  EXPECT_EQ(SufficientContactStiffness(hose, 0.00074), 0);
  // Twice as deep as allowed: 1.2 * 2^2 * 2e4.
  EXPECT_DOUBLE_EQ(SufficientContactStiffness(hose, 0.0015), 9.6e4);
  // Went through the body: 1.2 * (0.02 / 0.00075)^2 * 10 = 8.6e3 would stop nothing.
  hose.contact.stiffness = 10;
  EXPECT_EQ(SufficientContactStiffness(hose, 0.02), DefaultContactStiffness(hose));
}

// How deep a block sinks into the hose that it lifts 80 mm above the line between its clamps.
double DepthAfterLift(const CableModel& hose, double lift, int* substeps) {
  const Body block({Shape{Pose(), Box{{0.4, 0.4, 0.2}}}});
  CableSimulation simulation(hose, {&block}, {0, 0, -9.81});
  const auto surroundings = [&](double t) {
    constexpr double kLiftTime = 1;  // [s]
    const double x = std::min(1.0, t / kLiftTime);
    Motion motion =
        Motion::Resting({{0, 0, -0.3 + (lift + 0.2) * x * x * x * (10 - 15 * x + 6 * x * x)},
                         Eigen::Quaterniond::Identity()});
    motion.v.z() = (lift + 0.2) * 30 * x * x * (1 - x) * (1 - x) / kLiftTime;
    motion.a.z() = (lift + 0.2) * 60 * x * (1 - x) * (1 - 2 * x) / (kLiftTime * kLiftTime);
    return Surroundings{Motion::Resting(hose.a.X_LC), Motion::Resting(hose.b.X_LC), {motion}};
  };
  EXPECT_TRUE(simulation.Settle(surroundings(0)).ok);
  constexpr double kStep = 1e-3;
  double depth = 0;
  *substeps = 0;
  for (int i = 1; i <= 1100; ++i) {
    const StepOutcome outcome = simulation.Step(kStep, surroundings(kStep * i));
    EXPECT_TRUE(outcome.ok) << outcome.message;
    if (!outcome.ok) break;
    *substeps += outcome.substeps;
    depth = std::max(depth, simulation.DeepestContact().penetration);
  }
  return depth;
}

TEST(ContactStiffness, KeepsAHeavyHoseOutOfWhatLiftsIt) {
  const double allowed = kDeepestShareOfRadius * 0.015;
  int substeps = 0;
  EXPECT_LT(DepthAfterLift(Hose(), 0.08, &substeps), allowed);
  EXPECT_EQ(substeps, 1100) << "no step had to be done in parts";
}

TEST(ContactStiffness, WhatIsToldToDoDoes) {
  const double allowed = kDeepestShareOfRadius * 0.015;
  int substeps = 0;
  for (const double stiffness : {2e4, 2e5}) {
    CableModel hose = Hose();
    hose.contact.stiffness = stiffness;
    const double depth = DepthAfterLift(hose, 0.08, &substeps);
    EXPECT_GT(depth, allowed) << stiffness;
    hose.contact.stiffness = SufficientContactStiffness(hose, depth);
    EXPECT_LT(DepthAfterLift(hose, 0.08, &substeps), allowed) << stiffness;
  }
}

}  // namespace
}  // namespace cosserat_cable
