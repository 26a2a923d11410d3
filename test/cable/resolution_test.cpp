#include "cosserat_cable/cable/resolution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cable/cable_cases.h"
#include "cosserat_cable/cable/cable_simulation.h"

namespace cosserat_cable {
namespace {

/// A thin lead of 2 m: EI 1e-3 N m^2, EA 16 kN.
CableModel Lead(int elements) {
  CableModel lead = RoundCableModel(2, 0.004, 0.05, 1e-3, 1e-3, 1e-5);
  lead.elements = elements;
  lead.EA = 16e3;
  return lead;
}

TEST(ResolutionTest, TautElementsNeedToBeAsShortAsTheLayerAtTheClamps) {
  // L sqrt(T/(12 EI)) = 2 sqrt(80/0.012) = 163.3.
  EXPECT_EQ(ElementsFor(Lead(40), 80, 0).for_tension, 164);
  EXPECT_EQ(ElementsFor(Lead(40), -80, 0).for_tension, 0);  // pressed: not taut
  const std::string said = TooLongElements(Lead(40), 80, 0);
  EXPECT_NE(said.find("164 elements would do"), std::string::npos) << said;
  EXPECT_EQ(TooLongElements(Lead(164), 80, 0), "");
}

TEST(ResolutionTest, BentElementsTurnByHalfARadianAtMost) {
  // 2 m bent to a radius of 50 mm turn by 40 rad.
  EXPECT_EQ(ElementsFor(Lead(40), 0, 20).for_curvature, 80);
  const std::string said = TooLongElements(Lead(40), 0, 20);
  EXPECT_NE(said.find("turn by up to 1 rad"), std::string::npos) << said;
  EXPECT_NE(said.find("80 elements would do"), std::string::npos) << said;
}

TEST(ResolutionTest, TheLargestCurvatureIsAMeanOverAnElement) {
  // A lead between clamps that point aside by 0.02 rad: at the clamp its curvature is
  // angle sqrt(T/EI) and falls off over l = sqrt(EI/T). What an element of length h tells is its
  // turn by its length: all of the angle where h is many l.
  constexpr double kAngle = 0.02, kTension = 80, kWithin = 0.15;
  const double layer = std::sqrt(1e-3 / kTension);
  const auto largest = [&](int elements) {
    const CableModel lead = Lead(elements);
    CableSimulation simulation(lead, {}, Eigen::Vector3d::Zero());
    const Eigen::Quaterniond along(Eigen::AngleAxisd(kAngle, Eigen::Vector3d::UnitX()));
    Surroundings clamps;
    clamps.a = Motion::Resting({Eigen::Vector3d::Zero(), along});
    clamps.b = Motion::Resting({{0, 0, lead.length * (1 + kTension / lead.EA)}, along});
    EXPECT_TRUE(simulation.Settle(clamps).ok);
    return simulation.ReportForces().curvature_max;
  };
  for (const int elements : {20, 164, 1312}) {
    const double h = 2.0 / elements, mean = kAngle * (1 - std::exp(-h / layer)) / h;
    EXPECT_NEAR(largest(elements), mean, kWithin * mean) << elements;
    EXPECT_EQ(TooLongElements(Lead(elements), kTension, mean).empty(), elements >= 164);
  }
}

}  // namespace
}  // namespace cosserat_cable
