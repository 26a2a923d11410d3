#include <gtest/gtest.h>

#include <random>

#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

TEST(StaticsTest, ClosedLoopIsACircle) {
  constexpr double kTolerance = 1e-8;  // of the length: constant curvature is exact in this element
  constexpr double kLength = 1.0;
  RodModel model = RoundCable(kLength, 0.01, 0.1, 0.02, 0.015, 0, 0, 40);
  model.gravity.setZero();
  Rod rod(model);
  const Pose clamp;
  rod.SetConfiguration(BowedShape(clamp, clamp, kLength, 40, -Vector3d::UnitX()));
  ASSERT_TRUE(rod.Equilibrate().converged);
  // A polygon of 40 equal sides of h that turns by 2 pi: its corners' circle.
  const double radius = kLength / 40 / (2 * std::sin(M_PI / 40));
  Vector3d centre = Vector3d::Zero();
  for (int i = 0; i < 40; ++i) centre += rod.pose(i).p / 40;
  for (int i = 0; i < 40; ++i) EXPECT_NEAR((rod.pose(i).p - centre).norm(), radius, kTolerance);
  for (int e = 0; e < 40; ++e)
    EXPECT_NEAR(rod.curvature(e).head<2>().norm(), 2 * M_PI / kLength, kTolerance * 40);
}

// Elastica under a tip load, P L^2/EI = 1, 2, 5, 10: Mattiasson (1981), elliptic integrals.
TEST(StaticsTest, CantileverFollowsTheElastica) {
  constexpr double kTolerance = 1e-4;  // of the length, the table's last digits allow 1e-5
  const double load[] = {1, 2, 5, 10};
  const double w[] = {0.30172, 0.49346, 0.71379, 0.81061};
  const double u[] = {0.05643, 0.16064, 0.38763, 0.55500};
  RodModel model = RoundCable(1.0, 0.01, 0.1, 0.02, 0.015, 0, 0, 80);
  model.section.C_F.setConstant(1e6);  // neither shear nor stretch in the reference
  model.gravity.setZero();
  model.b = EndModel::Free();
  for (int k = 0; k < 4; ++k) {
    Rod rod(model);
    rod.SetConfiguration(StraightShape(Pose{}, 1.0, 80));
    const TipForce force({0.02 * load[k], 0, 0});
    ASSERT_TRUE(rod.Equilibrate(&force).converged);
    EXPECT_NEAR(rod.pose(80).p.x(), w[k], kTolerance) << load[k];
    EXPECT_NEAR(1 - rod.pose(80).p.z(), u[k], kTolerance) << load[k];
  }
}

// Bathe and Bolourchi (1979): a 45 degree bend of radius 100 under an out-of-plane tip load of 600.
TEST(StaticsTest, BendOfFortyFiveDegrees) {
  constexpr double kRelative = 1e-3;
  const Vector3d kTip(15.685, 47.150, 53.475);  // converged value of the literature's series
  constexpr double kRadius = 100, kAngle = M_PI / 4;
  constexpr int kElements = 64;
  RodModel model;
  model.length = kRadius * kAngle;
  model.elements = kElements;
  model.section.C_F = {5e6, 5e6, 1e7};
  model.section.C_M = {1e7 / 12, 1e7 / 12, 8.333e5};
  model.section.V_F.setZero();
  model.section.V_M.setZero();
  model.section.rhoA = 1;
  model.section.rhoJ.setOnes();
  model.section.kappa0 = {0, 1 / kRadius, 0};
  model.gravity.setZero();
  model.b = EndModel::Free();
  // In the x-y plane, from the origin along y, bending towards x; a2 is -z... a3 x a1.
  std::vector<Pose> nodes;
  for (int i = 0; i <= kElements; ++i) {
    const double phi = kAngle * i / kElements;
    Eigen::Matrix3d R;
    R.col(2) = Vector3d(std::sin(phi), std::cos(phi), 0);
    R.col(0) = Vector3d(std::cos(phi), -std::sin(phi), 0);
    R.col(1) = R.col(2).cross(R.col(0));
    nodes.push_back({Vector3d(kRadius * (1 - std::cos(phi)), kRadius * std::sin(phi), 0),
                     Eigen::Quaterniond(R)});
  }
  Rod rod(model);
  rod.SetConfiguration(nodes);
  const TipForce force({0, 0, 600});
  ASSERT_TRUE(rod.Equilibrate(&force).converged);
  EXPECT_LT((rod.pose(kElements).p - kTip).norm(), kRelative * kTip.norm())
      << rod.pose(kElements).p.transpose();
}

TEST(StaticsTest, ClampsCarryTheWeight) {
  constexpr double kTolerance = 1e-8;  // N; Newton stops at corrections of 1e-10
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto random = [&] { return Vector3d(uniform(rng), uniform(rng), uniform(rng)); };
  const RodModel model = RoundCable(0.3, 0.008, 0.1, 0.01, 0.008, 1e-4, 5e-5, 40);
  const double weight = 0.3 * 0.1 * 9.81;
  for (int k = 0; k < 200; ++k) {
    // Clamps anywhere within 85 % of the length, facing anywhere: loops, twists, nearly taut.
    const Pose a = Facing(random(), random().normalized());
    const Pose b = Facing(a.p + 0.85 * 0.3 * std::abs(uniform(rng)) * random().normalized(),
                          random().normalized());
    Rod rod(model);
    rod.SetConfiguration(BowedShape(a, b, 0.3, 40, model.gravity));
    const SolveReport report = rod.Equilibrate();
    ASSERT_TRUE(report.converged) << "case " << k;
    const Wrench at_a = rod.reaction_a(), at_b = rod.reaction_b();
    EXPECT_LT((at_a.force + at_b.force - Vector3d(0, 0, weight)).norm(), kTolerance);
    Vector3d moment = at_a.moment + at_b.moment + a.p.cross(at_a.force) + b.p.cross(at_b.force);
    for (int i = 0; i <= 40; ++i)
      moment +=
          rod.pose(i).p.cross(Vector3d(0, 0, (i == 0 || i == 40 ? -0.5 : -1.0) * weight / 40));
    EXPECT_LT(moment.norm(), kTolerance);
  }
}

TEST(StaticsTest, CollinearClampsBuckleIntoAnArch) {
  // Clamped-clamped column, end-shortening D/L = 0.2: rise h/L = 0.2663 (inextensible elastica).
  constexpr double kTolerance = 1e-3;
  RodModel model = RoundCable(1.0, 0.01, 0.1, 0.02, 0.015, 0, 0, 80);
  model.section.C_F.setConstant(1e6);
  model.gravity.setZero();
  Rod rod(model);
  Pose b;
  b.p.z() = 0.8;
  rod.SetConfiguration(BowedShape(Pose{}, b, 1.0, 80, Vector3d::Zero()));
  ASSERT_TRUE(rod.Equilibrate().converged);
  const Vector3d middle = rod.pose(40).p;
  EXPECT_NEAR(std::hypot(middle.x(), middle.y()), 0.2663, kTolerance);
}

}  // namespace
}  // namespace cosserat_cable::rod
