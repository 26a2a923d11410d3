// The energy balance, and that it would show a rod that makes or loses energy.
#include <gtest/gtest.h>

#include "cosserat_cable/rod/maxwell.h"
#include "cosserat_cable/rod/point_loads.h"
#include "rod/rod_cases.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

RodModel Cable(double eta_scale) {
  return RoundCable(0.2, 0.008, 0.15, 0.008, 0.006, eta_scale * 1e-4, eta_scale * 5e-5, 40);
}

TEST(EnergyTest, FreeDecayAtLargeDeflectionBalances) {
  // A cantilever let go from a deflection of half its length: all of the released energy is either
  // still there or dissipated.
  const double steps[] = {1e-3, 5e-4}, within[] = {2e-4, 1e-4};  // of the energy dissipated
  for (int i = 0; i < 2; ++i) {
    RodModel model = Cable(0.1);
    model.b = EndModel::Free();
    Rod rod(model);
    rod.SetConfiguration(StraightShape(Pose{}, 0.2, 40));
    const PointLoads pull(0.2, {{0.2, {0.6, 0, 0}}});
    ASSERT_TRUE(rod.Equilibrate(&pull).converged);
    ASSERT_GT(rod.pose(40).p.x(), 0.08);
    const double before = rod.elastic_energy() + rod.gravity_energy();
    const Pose clamp;
    for (int k = 0; k < std::lround(2 / steps[i]); ++k)
      ASSERT_TRUE(rod.Step(steps[i], clamp, clamp).converged);
    const EnergyBalance balance = rod.energy_balance();
    EXPECT_GT(balance.dissipated, 0.3 * before);
    Validate({"Numerics",
              std::string("free decay from half its length, dt ") + (i == 0 ? "1" : "0.5") +
                  " ms: energy unaccounted for / dissipated",
              "energy is conserved", 0, balance.Residual() / balance.dissipated, within[i], 40,
              steps[i]});
    EXPECT_EQ(balance.work_ends, 0);
  }
}

TEST(EnergyTest, ShakenClampsPayForWhatTheCableDissipates) {
  // The source paper's sweep; Maxwell branches and clamps that give way take part.
  constexpr double kWithin = 2e-4;  // of the energy dissipated
  for (bool extended : {false, true}) {
    RodModel model = Cable(1.0);
    if (extended) {
      SectionValue stiffness;
      stiffness.M.setConstant(0.002);
      model.branches = {std::make_shared<MaxwellBranch>(stiffness, 0.01)};
      model.a = EndModel::Sprung(Vector3d::Constant(1.0), Vector3d::Constant(1e-3));
    }
    const Pose a = Facing(Vector3d::Zero(), Vector3d::UnitZ());
    const Pose b{{0.1, 0, 0}, Eigen::Quaterniond(AngleAxisd(M_PI, Vector3d::UnitY()))};
    Rod rod(model);
    rod.SetConfiguration(BowedShape(a, b, 0.2, 40, model.gravity));
    ASSERT_TRUE(rod.Equilibrate().converged);
    Motion start;
    start.v.x() = 1.5e-3 * 2 * M_PI * 10;
    start.a.x() = 1.5e-3 * 8 * M_PI;
    rod.AddRigidMotion(start);
    for (int k = 1; k <= 3000; ++k) {
      const double t = k * 1e-3, phase = 2 * M_PI * (10 + 2 * t) * t;
      const auto shake = [&](Pose X) {
        X.p.x() += 1.5e-3 * std::sin(phase);
        return X;
      };
      ASSERT_TRUE(rod.Step(1e-3, shake(a), shake(b)).converged);
    }
    const EnergyBalance balance = rod.energy_balance();
    EXPECT_GT(balance.dissipated, 10 * std::abs(balance.stored));
    Validate({"Numerics",
              std::string("swept arch P2") +
                  (extended ? " with a Maxwell branch and a sprung clamp" : "") +
                  ": energy unaccounted for / dissipated",
              "energy is conserved", 0, balance.Residual() / balance.dissipated, kWithin, 40,
              1e-3});
  }
}

}  // namespace
}  // namespace cosserat_cable::rod
