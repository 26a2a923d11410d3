#include "cosserat_cable/cable/cable_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cable/cable_cases.h"
#include "cosserat_cable/cable/cable_rod.h"
#include "cosserat_cable/rod/point_loads.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

const Vector3d kGravity(0, 0, -9.81);

/// A hose hanging in a U between two clamps that face down and up, 0.2 m apart.
CableModel Hose() { return RoundCableModel(0.4, 0.01, 0.12, 0.035, 0.028, 1e-4); }

Surroundings HoseClamps() {
  Surroundings s;
  s.a.X.q = Eigen::Quaterniond(0, 1, 0, 0);  // a3 down
  s.b.X.p = {0, 0.2, 0};
  return s;
}

Shape BoxAt(const Vector3d& size, const Vector3d& p) { return {{p, {1, 0, 0, 0}}, Box{size}}; }

/// A rectangle in the x-y plane as an open mesh, one triangle pair.
Shape SheetAt(double half, const Vector3d& p) {
  TriangleMesh mesh;
  mesh.vertices = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return {{p, {1, 0, 0, 0}}, mesh};
}

double LowestPoint(const CableSimulation& cable) {
  double z = std::numeric_limits<double>::infinity();
  for (const Pose& node : cable.nodes()) z = std::min(z, node.p.z());
  return z;
}

TEST(CableSimulationTest, RestsSymmetricallyAndCarriesItsWeight) {
  constexpr double kForce = 1e-6;  // N, of 0.47 N
  CableSimulation cable(Hose(), {}, kGravity);
  ASSERT_TRUE(cable.Settle(HoseClamps()).ok);
  const CableReport report = cable.Report();
  EXPECT_NEAR(report.force_a.z() + report.force_b.z(), 0.4 * 0.12 * 9.81, kForce);
  EXPECT_NEAR(report.apex.y(), 0.1, 1e-6);
  EXPECT_TRUE(std::isinf(report.clearance));
}

/// Stands on both clamps in the plane of x and z, and is too heavy for that.
Surroundings StandingArch() {
  Surroundings s;
  s.b.X.p = {0.2, 0, 0};
  s.b.X.q = Eigen::Quaterniond(0, 0, 1, 0);  // a3 down
  return s;
}

TEST(CableSimulationTest, AnUnstableArchFallsToOneSideIfItIsToldTo) {
  const CableModel arch = RoundCableModel(0.4, 0.005, 0.2, 1e-3, 1e-3, 1e-5);
  CableSimulation stays(arch, {}, kGravity), falls(arch, {}, kGravity);
  EXPECT_EQ(stays.Settle(StandingArch()).remark, "");
  EXPECT_TRUE(stays.FindModes(1)[0].unstable());
  EXPECT_GT(LowestPoint(stays), -1e-9);

  const StepOutcome outcome = falls.Settle(StandingArch(), Unstable::kFalls);
  ASSERT_TRUE(outcome.ok) << outcome.message;
  EXPECT_NE(outcome.remark.find("unstable equilibrium"), std::string::npos);
  EXPECT_FALSE(falls.FindModes(1)[0].unstable());
  EXPECT_GT(falls.FindModes(1)[0].w, 1);
  // It has come down, and stays there.
  const Vector3d apex = falls.Report().apex;
  EXPECT_LT(apex.z(), stays.Report().apex.z() - 0.05);
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(falls.Step(1e-3, StandingArch()).ok);
  EXPECT_LT((falls.Report().apex - apex).norm(), 1e-7);
}

TEST(CableSimulationTest, AStableRestIsTheSameWithAndWithoutTheLook) {
  CableSimulation plain(Hose(), {}, kGravity), looked(Hose(), {}, kGravity);
  ASSERT_TRUE(plain.Settle(HoseClamps()).ok);
  const StepOutcome outcome = looked.Settle(HoseClamps(), Unstable::kFalls);
  ASSERT_TRUE(outcome.ok);
  EXPECT_EQ(outcome.remark, "");
  EXPECT_EQ(plain.Report().apex, looked.Report().apex);
}

TEST(CableSimulationTest, StaysAtRestWhereNothingMoves) {
  constexpr double kDrift = 1e-8;  // m
  CableSimulation cable(Hose(), {}, kGravity);
  const Surroundings still = HoseClamps();
  ASSERT_TRUE(cable.Settle(still).ok);
  const Vector3d apex = cable.Report().apex;
  for (int k = 0; k < 300; ++k) ASSERT_TRUE(cable.Step(1e-3, still).ok);
  EXPECT_LT((cable.Report().apex - apex).norm(), kDrift);
}

TEST(CableSimulationTest, SetsOutInStepWithClampsThatMoveAlready) {
  // In the middle of a ride, at 14 m/s, a steering and bumping wheel carrier: against the same run
  // begun at a rest of everything, far enough back for the cable to have forgotten it.
  constexpr double kDt = 1e-3, kRunUp = 1.0, kTime = 0.25;  // [s]
  constexpr double kEnergy = 2e-4;                          // of what was dissipated
  // The cable that came a long way lags behind its equilibria by the delay of its material, eta/EI,
  // at no more than the speed of the clamp, 0.02 m times w.
  const double lag = Hose().eta_EI1 / Hose().EI1 * 0.02 * 2 * M_PI * 2;  // [m]
  const auto at = [](double t) {
    Surroundings s = HoseClamps();
    // From rest at t = -kRunUp on: what is left of the ramp at t = 0 is nothing.
    const double w = 2 * M_PI * 2, r = std::min(1.0, (t + kRunUp) / (0.5 * kRunUp));
    const double ramp = r * r * r * (10 - 15 * r + 6 * r * r);
    Motion frame;
    frame.X.p.x() = 14 * t;
    frame.v.x() = 14;
    Motion carrier;
    carrier.X.p.z() = ramp * 0.02 * std::sin(w * t);
    carrier.v.z() = 0.02 * w * std::cos(w * t);
    carrier.a.z() = -0.02 * w * w * std::sin(w * t);
    carrier.X.q = Eigen::AngleAxisd(ramp * 0.3 * std::sin(w * t), Vector3d::UnitZ());
    carrier.omega.z() = 0.3 * w * std::cos(w * t);
    carrier.alpha.z() = -0.3 * w * w * std::sin(w * t);
    s.a = frame * s.a;
    s.b = frame * carrier * s.b;
    return s;
  };
  const auto run = [&](CableSimulation* cable, double from, double until) {
    for (int k = 1; k <= std::lround((until - from) / kDt); ++k)
      ASSERT_TRUE(cable->Step(kDt, at(from + k * kDt)).ok);
  };
  CableSimulation before(Hose(), {}, kGravity), cable(Hose(), {}, kGravity);
  Surroundings begin = at(-kRunUp);
  begin.b.v = begin.a.v;
  begin.b.omega.setZero();
  begin.b.a.setZero();
  begin.b.alpha.setZero();
  ASSERT_TRUE(before.Settle(begin).ok);
  run(&before, -kRunUp, 0);
  ASSERT_TRUE(cable.Settle(at(0)).ok);
  for (double t = 0; t < kTime; t += 0.05) {
    run(&before, t, t + 0.05);
    run(&cable, t, t + 0.05);
    EXPECT_LT((cable.Report().apex - before.Report().apex).norm(), lag) << t;
  }
  run(&cable, kTime, kTime + 2);
  const rod::EnergyBalance energy = cable.Report().energy;
  EXPECT_LT(std::abs(energy.Residual()), kEnergy * energy.dissipated);
}

TEST(CableSimulationTest, SameInputGivesSameBits) {
  const auto run = [] {
    const Body floor({BoxAt({1, 1, 0.1}, {0, 0.1, -0.27})});
    CableSimulation cable(Hose(), {&floor}, kGravity);
    Surroundings s = HoseClamps();
    s.obstacles.resize(1);
    EXPECT_TRUE(cable.Settle(s).ok);
    for (int k = 0; k < 200; ++k) {
      s.b.X.p.z() = -0.02 * std::sin(0.05 * k);
      EXPECT_TRUE(cable.Step(1e-3, s).ok);
    }
    return cable.Report().apex;
  };
  EXPECT_EQ(run(), run());
}

/// Drives a floor up against the hanging cable at 2 m/s, and back; the cable must stay above.
void ExpectStoppedBy(const Shape& shape, double top, double travel) {
  constexpr double kSpeed = 2.0, kDt = 1e-3;
  // A point of the centreline may sink in, but not through: less than the radius.
  constexpr double kRadius = 5e-3;
  const Body body({shape});
  CableSimulation cable(Hose(), {&body}, kGravity);
  Surroundings s = HoseClamps();
  s.obstacles.resize(1);
  s.obstacles[0].X.p = {0, 0.1, -0.35};
  ASSERT_TRUE(cable.Settle(s).ok);
  const auto check = [&] {
    ASSERT_TRUE(cable.Step(kDt, s).ok);
    for (const Pose& node : cable.nodes())
      ASSERT_GT(node.p.z() - (s.obstacles[0].X.p.z() + top), 0.0);
    for (const ContactPoint& point : cable.contacts()) ASSERT_LT(point.penetration, kRadius);
  };
  s.obstacles[0].v.z() = kSpeed;
  for (double z = 0; z < travel; z += kSpeed * kDt) {
    s.obstacles[0].X.p.z() += kSpeed * kDt;
    check();
  }
  EXPECT_GT(cable.Report().contact_force, 0);
  s.obstacles[0].v.setZero();
  for (int k = 0; k < 300; ++k) check();
  // At rest on the floor the weight of the hose costs a fraction of a millimetre.
  EXPECT_LT(-cable.Report().clearance, 0.05 * kRadius);
}

TEST(CableSimulationTest, ABoxAtTwoMetresPerSecondDoesNotPass) {
  ExpectStoppedBy(BoxAt({0.6, 0.6, 0.1}, {0, 0, -0.05}), 0, 0.22);
}
TEST(CableSimulationTest, AThinPlateDoesNotPass) {
  ExpectStoppedBy(BoxAt({0.6, 0.6, 0.002}, {0, 0, -0.001}), 0, 0.22);
}
TEST(CableSimulationTest, AnOpenSheetDoesNotPass) {
  ExpectStoppedBy(SheetAt(0.3, {0, 0, 0}), 0, 0.22);
}

TEST(CableSimulationTest, ALongCableLiesOnTheFloorThatItWouldHangThrough) {
  // Free, it would be 40 mm deep in a plate of 60 mm, nearer to its lower face.
  constexpr double kTop = -0.1;  // [m]
  // Pushed up by it, the hose falls on its side, slowly: what is left is some of its last swing.
  constexpr double kWeight = 0.4 * 0.12 * 9.81, kForce = 0.01 * kWeight;  // [N]
  constexpr double kMove = 1e-3;                                          // [m]
  const Body floor({BoxAt({1, 1, 0.06}, {0, 0.1, kTop - 0.03})});
  CableSimulation free(Hose(), {}, kGravity), cable(Hose(), {&floor}, kGravity);
  Surroundings s = HoseClamps();
  ASSERT_TRUE(free.Settle(s).ok);
  ASSERT_LT(LowestPoint(free), kTop - 0.03);
  s.obstacles.resize(1);
  const StepOutcome outcome = cable.Settle(s);
  ASSERT_TRUE(outcome.ok) << outcome.message;
  EXPECT_GT(LowestPoint(cable), kTop + 0.9 * 5e-3);
  const CableReport report = cable.Report();
  EXPECT_GT(report.contact_force, 0.1);
  EXPECT_NEAR(report.force_a.z() + report.force_b.z() + report.contact_force, kWeight, kForce);
  for (int k = 0; k < 200; ++k) ASSERT_TRUE(cable.Step(1e-3, s).ok);
  EXPECT_LT((cable.Report().apex - report.apex).norm(), kMove);
}

TEST(CableSimulationTest, SaysThatItWouldStartInsideOfABody) {
  const Body block({BoxAt({0.3, 0.6, 0.3}, {0, 0.1, 0})});  // around both clamps
  CableSimulation cable(Hose(), {&block}, kGravity);
  Surroundings s = HoseClamps();
  s.obstacles.resize(1);
  const StepOutcome outcome = cable.Settle(s);
  ASSERT_FALSE(outcome.ok);
  EXPECT_NE(outcome.message.find("mm deep in them"), std::string::npos) << outcome.message;
}

TEST(CableSimulationTest, TellsTheClearanceWithoutContact) {
  constexpr double kTolerance = 1e-6;  // the lowest point is a node, and nodes are looked at
  CableSimulation free(Hose(), {}, kGravity);
  ASSERT_TRUE(free.Settle(HoseClamps()).ok);
  const double floor_z = LowestPoint(free) - 0.005 - 0.02;  // 20 mm below the surface
  const Body floor({BoxAt({1, 1, 0.1}, {0, 0, floor_z - 0.05})});
  CableSimulation cable(Hose(), {&floor}, kGravity);
  Surroundings s = HoseClamps();
  s.obstacles.resize(1);
  ASSERT_TRUE(cable.Settle(s).ok);
  EXPECT_NEAR(cable.Report().clearance, 0.02, kTolerance);
  // The same after it has moved, and beyond reach none.
  for (int k = 0; k < 40; ++k) {
    s.obstacles[0].X.p.z() -= 5e-4;
    ASSERT_TRUE(cable.Step(1e-3, s).ok);
  }
  EXPECT_NEAR(cable.Report().clearance, 0.04, kTolerance);
  for (int k = 0; k < 40; ++k) {
    s.obstacles[0].X.p.z() -= 5e-4;
    ASSERT_TRUE(cable.Step(1e-3, s).ok);
  }
  EXPECT_TRUE(std::isinf(cable.Report().clearance));
}

TEST(CableSimulationTest, SettlesOnABodyThatItTouchesAtRest) {
  CableSimulation free(Hose(), {}, kGravity);
  ASSERT_TRUE(free.Settle(HoseClamps()).ok);
  const double floor_z = LowestPoint(free) + 0.01;
  const Body floor({BoxAt({1, 1, 0.1}, {0, 0, floor_z - 0.05})});
  CableSimulation cable(Hose(), {&floor}, kGravity);
  Surroundings s = HoseClamps();
  s.obstacles.resize(1);
  const StepOutcome outcome = cable.Settle(s);
  ASSERT_TRUE(outcome.ok) << outcome.message;
  const CableReport report = cable.Report();
  EXPECT_NEAR(report.force_a.z() + report.force_b.z() + report.contact_force, 0.4 * 0.12 * 9.81,
              1e-6);
  EXPECT_LT(std::abs(report.clearance), 1e-3);
}

TEST(CableSimulationTest, AGivenLoadActsBesideContact) {
  constexpr double kForce = 1e-6;  // N, of 0.77 N
  constexpr double kDrift = 1e-7;  // m, in contact
  CableSimulation free(Hose(), {}, kGravity);
  ASSERT_TRUE(free.Settle(HoseClamps()).ok);
  const double floor_z = LowestPoint(free) + 0.01;
  const Body floor({BoxAt({1, 1, 0.1}, {0, 0, floor_z - 0.05})});
  CableSimulation cable(Hose(), {&floor}, kGravity);
  const rod::PointLoads load(0.4, {{0.1, {0, 0, -0.3}}});
  Surroundings s = HoseClamps();
  s.obstacles.resize(1);
  s.load = &load;
  ASSERT_TRUE(cable.Settle(s).ok);
  const CableReport report = cable.Report();
  EXPECT_GT(report.contact_force, 0);
  EXPECT_NEAR(report.force_a.z() + report.force_b.z() + report.contact_force,
              0.4 * 0.12 * 9.81 + 0.3, kForce);
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(cable.Step(1e-3, s).ok);
  EXPECT_LT((cable.Report().apex - report.apex).norm(), kDrift);
  // Without the load it is no longer at rest.
  s.load = nullptr;
  for (int k = 0; k < 40; ++k) ASSERT_TRUE(cable.Step(1e-3, s).ok);
  EXPECT_GT((cable.Report().apex - report.apex).norm(), 1e3 * kDrift);
}

TEST(CableSimulationTest, ASectionThatChangesIsTakenFromTheStepOn) {
  constexpr double kSame = 1e-9;  // m, of equilibria
  CableModel soft = Hose();
  soft.EI1 = soft.EI2 = 0.5 * Hose().EI1;
  const rod::Section section = MakeRodModel(soft, kGravity).section;
  CableSimulation other(soft, {}, kGravity), cable(Hose(), {}, kGravity);
  Surroundings s = HoseClamps();
  ASSERT_TRUE(other.Settle(s).ok);
  ASSERT_TRUE(cable.Settle(s).ok);
  const Vector3d stiff_apex = cable.Report().apex;
  s.section = &section;
  ASSERT_TRUE(cable.Step(1e-3, s).ok);
  s.section = nullptr;  // it stays
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(cable.Step(1e-3, s).ok);
  EXPECT_GT((cable.Report().apex - stiff_apex).norm(), 1e3 * kSame);
  s.section = &section;
  ASSERT_TRUE(cable.Settle(s).ok);
  EXPECT_LT((cable.Report().apex - other.Report().apex).norm(), kSame);
}

TEST(CableSimulationTest, GoesOnFromARodThatMoves) {
  // A rod that was stepped by itself for a while, and one that goes all the way.
  const rod::RodModel model = MakeRodModel(Hose(), kGravity);
  CableSimulation settled(Hose(), {}, kGravity);
  ASSERT_TRUE(settled.Settle(HoseClamps()).ok);
  rod::Rod rod(model);
  rod.SetConfiguration(settled.nodes());
  Surroundings s = HoseClamps();
  const auto move = [&](int k) { s.b.X.p.z() = 0.01 * std::sin(0.1 * k); };
  rod::Rod all_the_way(rod);
  for (int k = 1; k <= 50; ++k) {
    move(k);
    ASSERT_TRUE(rod.Step(1e-3, s.a.X, s.b.X).converged);
    ASSERT_TRUE(all_the_way.Step(1e-3, s.a.X, s.b.X).converged);
  }
  CableSimulation cable(Hose(), std::move(rod), s);
  for (int k = 51; k <= 100; ++k) {
    move(k);
    ASSERT_TRUE(cable.Step(1e-3, s).ok);
    ASSERT_TRUE(all_the_way.Step(1e-3, s.a.X, s.b.X).converged);
  }
  for (int i = 0; i <= Hose().elements; ++i) EXPECT_EQ(cable.node(i).p, all_the_way.pose(i).p);
}

TEST(CableSimulationTest, AMotionThatIsNotFiniteIsRefused) {
  CableSimulation cable(Hose(), {}, kGravity);
  Surroundings s = HoseClamps();
  ASSERT_TRUE(cable.Settle(s).ok);
  const Vector3d apex = cable.Report().apex;
  s.b.X.p.x() = std::numeric_limits<double>::quiet_NaN();
  const StepOutcome outcome = cable.Step(1e-3, s);
  EXPECT_FALSE(outcome.ok);
  EXPECT_NE(outcome.message.find("not finite"), std::string::npos);
  EXPECT_EQ(cable.Report().apex, apex);
}

TEST(CableSimulationTest, AJoltTakesSmallerStepsOrFailsCleanly) {
  CableSimulation cable(Hose(), {}, kGravity);
  Surroundings s = HoseClamps();
  ASSERT_TRUE(cable.Settle(s).ok);
  s.b.X.p = {30, -40, 50};  // torn off
  const StepOutcome outcome = cable.Step(1e-3, s);
  EXPECT_EQ(outcome.ok, outcome.message.empty());
  for (const Pose& node : cable.nodes()) EXPECT_TRUE(node.p.allFinite());
}

TEST(CableSimulationTest, FarFromTheOriginNothingChanges) {
  constexpr double kTolerance = 1e-7;  // m; positions of 1 km have 1e-13
  const auto apex = [](const Vector3d& origin) {
    CableSimulation cable(Hose(), {}, kGravity);
    Surroundings s = HoseClamps();
    s.a.X.p += origin;
    s.b.X.p += origin;
    EXPECT_TRUE(cable.Settle(s).ok);
    for (int k = 1; k <= 100; ++k) {
      s.b.X.p.z() = origin.z() + 0.01 * std::sin(0.1 * k);
      s.b.v.z() = 1.0 * std::cos(0.1 * k);
      EXPECT_TRUE(cable.Step(1e-3, s).ok);
    }
    return Vector3d(cable.Report().apex - origin);
  };
  EXPECT_LT((apex({0, 0, 0}) - apex({800, -600, 30})).norm(), kTolerance);
}

}  // namespace
}  // namespace cosserat_cable
