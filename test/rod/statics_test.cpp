#include <gtest/gtest.h>

#include <random>

#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

/// What the clamps' forces and the rod's weight lack to balance [N], [N m].
struct Unbalance {
  double force, moment;
};

Unbalance LeftOver(const Rod& rod, const Pose& a, const Pose& b) {
  const int n = rod.elements();
  const Vector3d weight = rod.model().length * rod.model().section.rhoA * rod.model().gravity;
  const Wrench at_a = rod.reaction_a(), at_b = rod.reaction_b();
  Vector3d moment = at_a.moment + at_b.moment + a.p.cross(at_a.force) + b.p.cross(at_b.force);
  for (int i = 0; i <= n; ++i)
    moment += rod.pose(i).p.cross((i == 0 || i == n ? 0.5 : 1.0) / n * weight);
  return {(at_a.force + at_b.force + weight).norm(), moment.norm()};
}

TEST(StaticsTest, ClosedLoopIsACircle) {
  // Of the length. Constant curvature is exact in this element but for how an arc's length is made
  // of its chord: (2 pi/40)^4/1920 = 3e-7 of it are left out, 5e-8 in the radius.
  constexpr double kTolerance = 1e-7;
  constexpr double kLength = 1.0;
  RodModel model = RoundCable(kLength, 0.01, 0.1, 0.02, 0.015, 0, 0, 40);
  model.gravity.setZero();
  Rod rod(model);
  const Pose clamp;
  rod.SetConfiguration(BowedShape(clamp, clamp, kLength, 40, -Vector3d::UnitX()));
  ASSERT_TRUE(rod.Equilibrate().converged);
  const double radius = kLength / (2 * M_PI);
  Vector3d centre = Vector3d::Zero();
  for (int i = 0; i < 40; ++i) centre += rod.pose(i).p / 40;
  for (int i = 0; i < 40; ++i) EXPECT_NEAR((rod.pose(i).p - centre).norm(), radius, kTolerance);
  for (int e = 0; e < 40; ++e)
    EXPECT_NEAR(rod.curvature(e).head<2>().norm(), 2 * M_PI / kLength, kTolerance * 40);
}

TEST(StaticsTest, ClampsCarryTheWeight) {
  constexpr double kTolerance = 1e-8;  // N; Newton stops at corrections of 1e-10
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto random = [&] { return Vector3d(uniform(rng), uniform(rng), uniform(rng)); };
  const RodModel model = RoundCable(0.3, 0.008, 0.1, 0.01, 0.008, 1e-4, 5e-5, 40);
  for (int k = 0; k < 200; ++k) {
    // Clamps anywhere within 85 % of the length, facing anywhere: loops, twists, nearly taut.
    const Pose a = Facing(random(), random().normalized());
    const Pose b = Facing(a.p + 0.85 * 0.3 * std::abs(uniform(rng)) * random().normalized(),
                          random().normalized());
    Rod rod(model);
    rod.SetConfiguration(BowedShape(a, b, 0.3, 40, model.gravity));
    const SolveReport report = rod.Equilibrate();
    ASSERT_TRUE(report.converged) << "case " << k;
    const Unbalance left = LeftOver(rod, a, b);
    EXPECT_LT(left.force, kTolerance);
    EXPECT_LT(left.moment, kTolerance);
  }
}

// Few elements, between clamps that turn away from a taut rod: each turns by up to three radians.
TEST(StaticsTest, ElementsThatTurnFarComeToRest) {
  constexpr double kTolerance = 1e-7;   // of the largest force: of corrections, 1e-10, times EA/T
  constexpr int kMostIterations = 300;  // 243 were seen
  std::mt19937 rng(12);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto random = [&] { return Vector3d(uniform(rng), uniform(rng), uniform(rng)); };
  for (int k = 0; k < 200; ++k) {
    const double EI = std::pow(10, 2 * uniform(rng) - 2), diameter = 0.005;
    const RodModel model =
        RoundCable(0.3, diameter, 0.05, EI, 0.8 * EI, 0, 0, 4 + static_cast<int>(rng() % 17));
    const Pose a = Facing(random(), random().normalized());
    const Pose b = Facing(a.p + (0.9 + 0.1 * std::abs(uniform(rng))) * 0.3 * random().normalized(),
                          random().normalized());
    Rod rod(model);
    rod.SetConfiguration(BowedShape(a, b, 0.3, model.elements, model.gravity));
    const SolveReport report = rod.Equilibrate();
    ASSERT_TRUE(report.converged) << "case " << k;
    EXPECT_LT(report.iterations, kMostIterations) << "case " << k;
    double largest = rod.reaction_a().force.norm();
    for (int e = 0; e < model.elements; ++e) largest = std::max(largest, rod.force(e).norm());
    const Unbalance left = LeftOver(rod, a, b);
    EXPECT_LT(left.force, kTolerance * largest) << "case " << k;
    EXPECT_LT(left.moment, kTolerance * largest * model.length) << "case " << k;
  }
}

// Braided hoses are a million times stiffer against stretch than against bending.
TEST(StaticsTest, StiffnessAgainstStretchCostsFewIterations) {
  constexpr int kMostIterations = 100;  // 61 were seen, and above 300 by plain descent
  for (const double C_F : {1e3, 1e6, 1e8, 1e10})
    for (const int elements : {20, 80}) {
      RodModel model = RoundCable(1, 0.01, 0.1, 0.02, 0.015, 0, 0, elements);
      model.section.C_F.setConstant(C_F);
      Rod rod(model);
      const Pose a;
      for (const double span : {0.9, 0.5, 0.2}) {
        const Pose b = Facing(Vector3d(span, 0, 0.1), -Vector3d::UnitZ());
        rod.SetConfiguration(BowedShape(a, b, 1, elements, model.gravity));
        const Pose moved = Facing(b.p + Vector3d(0, 0.3, 0), Vector3d(1, 0, -1).normalized());
        for (const Pose& clamp : {b, moved}) {
          rod.SetClamps(a, clamp);
          const SolveReport report = rod.Equilibrate();
          EXPECT_TRUE(report.converged) << C_F << ' ' << elements << ' ' << span;
          EXPECT_LE(report.iterations, kMostIterations) << C_F << ' ' << elements << ' ' << span;
        }
      }
    }
}

}  // namespace
}  // namespace cosserat_cable::rod
