// A wall in the way of a swing is promised by an obstacle that stands near it.
#include "../../src/diagnosis/trial_obstacles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../../src/diagnosis/screening.h"
#include "pulled_set.h"

namespace cosserat_cable {
namespace {

// The cable is pulled towards -x in clamp a's frame; the wall stands at x = 0.02, facing it.
constexpr double kDeflection = 0.06, kWall = -0.02;  // [m]
constexpr double kFacing = 3.14159265358979323846;   // azimuth of its normal
// Places are a few depths of the motion apart, and directions a twelfth of a turn.
constexpr double kNear = 0.01, kNearAngle = 0.3;  // [m], [rad]

double Of(const Trial& trial, const std::string& name) {
  return trial.Values().at("extensions.contact.plane." + name);
}

TEST(TrialObstacles, OneThatIsThereAsAWholeStandsNearTheWall) {
  Specimen specimen = testing::CableSpecimen();
  CableExtension wall;
  wall.name = "contact";
  wall.parts = {{{"plane.azimuth", kFacing}, {"plane.elevation", 0.0}, {"plane.offset", kWall}}};
  specimen.cable.extensions.push_back(wall);
  const MeasurementSet set = testing::Pulled(kDeflection, specimen);
  Problems problems;
  FitProblem problem(set, {}, &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  const FitPoint plain = problem.At(problem.unknowns().StartValues());
  ASSERT_TRUE(plain.ok) << plain.message;
  // The plain cable swings far beyond the wall.
  ASSERT_GT(plain.cost, 100 * plain.samples);
  std::vector<Trial> trials = TrialObstacles(problem, plain, true);
  const std::vector<Screened> screened = Screen(problem, plain, trials);
  ASSERT_FALSE(screened.empty());
  const Trial& best = screened.front().trial;
  ASSERT_EQ(best.Values().count("extensions.contact.plane.offset"), 1u);
  EXPECT_FALSE(best.components.front().grows());
  EXPECT_LT(std::abs(std::remainder(Of(best, "azimuth") - kFacing, 2 * kFacing)), kNearAngle);
  EXPECT_NEAR(Of(best, "offset"), kWall, kNear);
  // Around it there is a better one, or it is the best itself.
  const std::vector<Screened> around = Screen(problem, plain, ObstaclesAround(best, 1, 0.25));
  ASSERT_FALSE(around.empty());
  EXPECT_GE(around.front().drop, screened.front().drop);
}

TEST(TrialObstacles, AreFaintUnlessAskedForAsAWhole) {
  const MeasurementSet set = testing::Pulled(kDeflection, testing::CableSpecimen());
  Problems problems;
  FitProblem problem(set, {}, &problems);
  const FitPoint plain = problem.At(problem.unknowns().StartValues());
  ASSERT_TRUE(plain.ok) << plain.message;
  for (const Trial& trial : TrialObstacles(problem, plain, false))
    EXPECT_TRUE(trial.components.front().grows());
}

}  // namespace
}  // namespace cosserat_cable
