// Ends that are pinned, free, sprung or held in part; prescribed loads; lumped bodies.
#include <gtest/gtest.h>

#include <algorithm>

#include "cosserat_cable/rod/point_loads.h"
#include "rod/ringing.h"
#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kLength = 0.3, kEI = 0.02, kGJ = 0.015;

RodModel Weightless(int elements = 40) {
  RodModel model = RoundCable(kLength, 0.004, 0.05, kEI, kGJ, 0, 0, elements);
  model.section.V_F.setZero();
  model.gravity.setZero();
  return model;
}

Rod Straight(const RodModel& model) {
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, model.length, model.elements));
  return rod;
}

TEST(EndsTest, AFollowerForceTurnsWithTheSection) {
  // At equilibrium the clamp carries the force in the direction in which it has turned.
  constexpr double kTolerance = 1e-7;  // [N]
  RodModel model = Weightless();
  model.b = EndModel::Free();
  Rod rod = Straight(model);
  PointLoads load(kLength, {{kLength, {0.3, 0, 0}}});
  load.loads[0].follower = true;
  ASSERT_TRUE(rod.Equilibrate(&load).converged);
  const Vector3d carried = rod.pose(40).q * Vector3d(0.3, 0, 0);
  EXPECT_LT((rod.reaction_a().force + carried).norm(), kTolerance);
  EXPECT_GT(std::acos(carried.x() / 0.3), 0.3);  // it has turned by far
}

TEST(EndsTest, ASprungClampGivesWay) {
  // Small tip force on a cantilever with a root spring: P L^3/(3 EI) + P L^2/k + P L/GA.
  constexpr double kRelative = 1e-4;  // large-rotation effects at 1 mm are 1e-5
  constexpr double kForce = 0.002, kSpring = 0.1;
  RodModel model = Weightless(80);
  model.a = EndModel::Sprung({kSpring, kSpring, kSpring}, Vector3d::Zero());
  model.b = EndModel::Free();
  Rod rod = Straight(model);
  const PointLoads load(kLength, {{kLength, {kForce, 0, 0}}});
  ASSERT_TRUE(rod.Equilibrate(&load).converged);
  const double expected = kForce * (std::pow(kLength, 3) / (3 * kEI) + kLength * kLength / kSpring +
                                    kLength / model.section.C_F.x());
  EXPECT_NEAR(rod.pose(80).p.x(), expected, kRelative * expected);
  EXPECT_NEAR(rod.reaction_a().moment.y(), -kForce * kLength, kRelative * kForce * kLength);
}

TEST(EndsTest, APinnedRodHangsFromItsPinsWithoutMoments) {
  constexpr double kTolerance = 1e-8;  // [N m]; Newton stops at corrections of 1e-10
  RodModel model = RoundCable(kLength, 0.004, 0.05, kEI / 100, kGJ / 100, 0, 0, 40);
  model.a = model.b = EndModel::Pinned();
  Rod rod(model);
  const Pose a = Facing({0, 0, 0}, Vector3d(1, 0, -1).normalized());
  const Pose b = Facing({0.2, 0, 0}, Vector3d(1, 0, 1).normalized());
  rod.SetConfiguration(BowedShape(a, b, kLength, 40, model.gravity));
  ASSERT_TRUE(rod.Equilibrate().converged);
  EXPECT_LT((rod.pose(0).p - a.p).norm() + (rod.pose(40).p - b.p).norm(), 1e-12);
  EXPECT_LT(rod.reaction_a().moment.norm(), kTolerance);
  EXPECT_LT(rod.reaction_b().moment.norm(), kTolerance);
  EXPECT_NEAR(rod.reaction_a().force.z() + rod.reaction_b().force.z(), kLength * 0.05 * 9.81,
              kTolerance);
}

TEST(EndsTest, PartlyHeldEndsKeepWhatTheyHoldWhileTheClampMoves) {
  // A slide along the clamp's axis that lets the section turn about that axis only, on a clamp that
  // swings and shakes.
  constexpr double kTolerance = 1e-12;
  // [N] Newton may stop 3e-9 m from balance, where the axial stiffness of an element is 1.3e6 N/m.
  constexpr double kNoForce = 1e-4;
  RodModel model = RoundCable(kLength, 0.004, 0.05, kEI, kGJ, 1e-5, 1e-5, 20);
  model.b.translation = {true, true, false};
  model.b.rotation = {true, true, false};
  Rod rod = Straight(model);
  ASSERT_TRUE(rod.Equilibrate().converged);
  Pose b;
  b.p.z() = kLength;
  double slid = 0, turned = 0;
  for (int k = 1; k <= 400; ++k) {
    const double t = k * 1e-3, w = 2 * M_PI * 3;
    const double f = std::pow(1 - std::cos(w * t), 3);  // from rest, with no jump
    Pose moved = b;
    moved.p += 2e-3 * f * Vector3d(1, 0.5, 0);
    moved.q = AngleAxisd(0.05 * f, Vector3d::UnitY());
    ASSERT_TRUE(rod.Step(1e-3, Pose{}, moved).converged) << t;
    const Vector3d d = moved.q.conjugate() * (rod.pose(20).p - moved.p);
    EXPECT_LT(std::abs(d.x()) + std::abs(d.y()), kTolerance);
    const Eigen::Vector3d across = moved.q.conjugate() * rod.pose(20).q * Vector3d::UnitZ();
    EXPECT_LT((across - Vector3d::UnitZ()).norm(), 1e-9);
    slid = std::max(slid, std::abs(d.z()));
    turned = std::max(turned, rod.pose(20).q.angularDistance(moved.q));
    // What it does not hold carries no load.
    EXPECT_LT(std::abs((moved.q.conjugate() * rod.reaction_b().force).z()), kNoForce);
    EXPECT_LT(std::abs((moved.q.conjugate() * rod.reaction_b().moment).z()), kNoForce * kLength);
  }
  EXPECT_GT(slid, 1e-5);
}

TEST(EndsTest, AClampThatGivesWayMayMoveAsFastAsARigidOne) {
  // It starts at 1 m/s from rest, a tenth of an element in a step: Newton's worst step needs no
  // more iterations than with a rigid clamp.
  const auto most_iterations = [](const EndModel& end) {
    RodModel model = RoundCable(0.4, 0.01, 0.12, 0.035, 0.028, 1e-4, 5e-5, 40);
    model.b = end;
    Rod rod(model);
    const Pose a = Facing({0, 0, 0}, -Vector3d::UnitZ());
    Pose b = Facing({0, 0.2, 0}, Vector3d::UnitZ());
    rod.SetConfiguration(BowedShape(a, b, model.length, 40, model.gravity));
    EXPECT_TRUE(rod.Equilibrate().converged);
    int most = 0;
    for (int k = 1; k <= 100; ++k) {
      b.p.z() = 0.01 * std::sin(0.1 * k);
      const SolveReport report = rod.Step(1e-3, a, b);
      EXPECT_TRUE(report.converged) << k;
      most = std::max(most, report.iterations);
    }
    return most;
  };
  const int rigid = most_iterations({});
  for (const bool torsion_rigid : {false, true}) {
    EndModel end = EndModel::Sprung({1, 1, 1}, Vector3d::Zero());
    end.rotation[2] = torsion_rigid;
    EXPECT_LE(most_iterations(end), rigid) << torsion_rigid;
  }
}

TEST(EndsTest, ACantileverWithATipMassSwingsAsRayleighSays) {
  // w^2 = 3 EI/(L^3 (m + 0.2357 rhoA L)), physics of a light beam with a heavy tip; Rayleigh's
  // value is high by less than 0.1 % where the tip is that heavy.
  constexpr double kRelative = 2e-3;
  constexpr double kTip = 0.05;
  RodModel model = Weightless();
  model.b = EndModel::Free();
  model.bodies = {{kLength, kTip}};
  Rod rod = Straight(model);
  const PointLoads pull(kLength, {{kLength, {0.002, 0, 0}}});
  ASSERT_TRUE(rod.Equilibrate(&pull).converged);
  const Pose clamp;
  std::vector<double> tip;
  for (int k = 0; k < 2000; ++k) {
    ASSERT_TRUE(rod.Step(1e-3, clamp, clamp).converged);
    tip.push_back(rod.pose(40).p.x());
  }
  const double w = std::sqrt(3 * kEI / (std::pow(kLength, 3) * (kTip + 0.2357 * 0.05 * kLength)));
  EXPECT_NEAR(Listen(tip, 1e-3).Omega, w, kRelative * w);
}

}  // namespace
}  // namespace cosserat_cable::rod
