#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cable/cable_cases.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/math/rotation.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

const Vector3d kGravity(0, 0, -9.81);

/// config/cables/car.yaml's cable of a wheel speed sensor, in a U in the y-z plane.
CableModel SensorCable() { return RoundCableModel(0.4, 0.005, 0.03, 2.5e-3, 2.5e-3, 1e-5); }

Surroundings Clamps() {
  Surroundings s;
  s.a.X.q = Eigen::Quaterniond(0, 1, 0, 0);  // a3 down
  s.b.X.p = {0, 0.2, 0};
  return s;
}

TEST(CableModesTest, ASensorCableSwaysOutOfItsPlaneFirst) {
  // What config/cables/car.yaml says of it, to the digits given there.
  CableSimulation cable(SensorCable(), {}, kGravity);
  ASSERT_TRUE(cable.Settle(Clamps()).ok);
  const std::vector<rod::Mode> modes = cable.FindModes(2);
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_EQ(modes[0].kind, rod::ModeKind::kOutOfPlane);
  EXPECT_NEAR(modes[0].w / (2 * M_PI), 5, 0.5);
  EXPECT_NEAR(modes[0].zeta, 0.06, 0.005);
  EXPECT_EQ(modes[1].kind, rod::ModeKind::kInPlane);
  EXPECT_NEAR(modes[1].w / (2 * M_PI), 10, 1.2);
  EXPECT_NEAR(modes[1].zeta, 0.13, 0.02);
}

/// Shakes both clamps once along the apex's motion in the first mode, and holds what follows to the
/// first mode.
void ExpectRingsDownAsItsFirstMode(CableSimulation* cable, const Surroundings& rest) {
  // (w dt)^2/12 = 1e-4; what is left of other modes after the first swings, less.
  constexpr double kFrequency = 5e-4, kDamping = 0.01;
  constexpr double kDt = 1e-3, kPulse = 0.06, kPush = 1e-5;  // [s], [s], [m]
  const rod::Mode mode = cable->FindModes(1)[0];
  const Vector3d along = mode.displacement[mode.displacement.size() / 2].normalized();
  const Vector3d apex = cable->Report().apex;
  std::vector<double> zeros, extrema;
  double before = 0, last = 0;
  for (int k = 1; zeros.size() < 9 && k < 3000; ++k) {
    Surroundings then = rest;
    const double t = k * kDt, w = 2 * M_PI / kPulse;
    if (t < kPulse)
      for (Motion* clamp : {&then.a, &then.b}) {
        clamp->X.p += 0.5 * kPush * (1 - std::cos(w * t)) * along;
        clamp->v += 0.5 * kPush * w * std::sin(w * t) * along;
        clamp->a += 0.5 * kPush * w * w * std::cos(w * t) * along;
      }
    ASSERT_TRUE(cable->Step(kDt, then).ok);
    const double x = (cable->Report().apex - apex).dot(along);
    if (t > 3 * kPulse) {
      if (last * x < 0) zeros.push_back((k - 1 + last / (last - x)) * kDt);
      if (!zeros.empty() && (last - before) * (x - last) < 0) {
        const double curvature = before - 2 * last + x, slope = 0.5 * (x - before);
        extrema.push_back(std::abs(last - 0.5 * slope * slope / curvature));
      }
    }
    before = last;
    last = x;
  }
  ASSERT_EQ(zeros.size(), 9u);
  const double w_damped = 8 * M_PI / (zeros[8] - zeros[0]);
  const double decrement = std::log(extrema.front() / extrema.back()) / (extrema.size() - 1);
  EXPECT_NEAR(w_damped, mode.w_damped(), kFrequency * w_damped);
  EXPECT_NEAR(decrement / std::hypot(M_PI, decrement), mode.zeta, kDamping * mode.zeta);
}

TEST(CableModesTest, AShakenCableRingsDownAsItsFirstModeSays) {
  CableSimulation cable(SensorCable(), {}, kGravity);
  ASSERT_TRUE(cable.Settle(Clamps()).ok);
  ExpectRingsDownAsItsFirstMode(&cable, Clamps());
}

TEST(CableModesTest, SoDoesOneInClampsThatGiveWayAndAMaterialThatRelaxes) {
  CableModel model = SensorCable();
  model.extensions = {
      {"maxwell", {{{"tau", 0.02}, {"EI1", 1e-4}, {"EI2", 1e-4}, {"GJ", 1e-4}, {"EA", 0}}}},
      {"clamp_compliance", {{{"a.bending", 0.02}, {"b.bending", 0.03}, {"b.torsion", 0.02}}}},
      {"clamp_damping", {{{"a.bending", 1e-5}, {"b.bending", 1e-5}}}}};
  // One clamp is skew, so that bending and torsion mix and the ends turn by 0.2 rad.
  Surroundings clamps = Clamps();
  clamps.b.X.q = RotationExp(Vector3d(0.3, 0.5, 0.8));
  CableSimulation cable(model, {}, kGravity);
  ASSERT_TRUE(cable.Settle(clamps).ok);
  ASSERT_GT(cable.nodes().front().q.angularDistance(clamps.a.X.q), 0.1);
  ExpectRingsDownAsItsFirstMode(&cable, clamps);
}

TEST(CableModesTest, OnePushedUpByAFloorFallsAsItsUnstableModeSays) {
  // The floor is 10 mm above where the U's bottom would hang, and without friction: standing on it
  // upright is an equilibrium, from which the least push makes the cable fall over.
  constexpr double kGrowth = 0.01, kDt = 1e-3, kPush = 1e-8;  // [m]
  CableSimulation hanging(SensorCable(), {}, kGravity);
  Surroundings clamps = Clamps();
  ASSERT_TRUE(hanging.Settle(clamps).ok);
  double bottom = 0;
  for (const Pose& node : hanging.nodes()) bottom = std::min(bottom, node.p.z());
  const Shape floor{{{0, 0.1, bottom - 0.04}, {1, 0, 0, 0}}, Box{Vector3d(1, 1, 0.1)}};
  const Body body({floor});
  clamps.obstacles.push_back(Motion::Resting(Pose{}));
  CableSimulation lying(SensorCable(), {&body}, kGravity);
  ASSERT_TRUE(lying.Settle(clamps).ok);
  ASSERT_GT(lying.Report().contact_force, 0);
  const rod::Mode mode = lying.FindModes(1)[0];
  ASSERT_TRUE(mode.unstable());
  EXPECT_EQ(mode.w, 0);
  clamps.a.X.p.x() += kPush;
  clamps.b.X.p.x() += kPush;
  double early = 0, late = 0;
  for (int k = 1; k <= 300; ++k) {
    ASSERT_TRUE(lying.Step(kDt, clamps).ok);
    late = lying.Report().apex.x() - kPush;
    if (k == 200) early = late;
  }
  EXPECT_LT(std::abs(late), 1e-3);
  EXPECT_NEAR(std::log(late / early) / (100 * kDt), mode.lambda.real(),
              kGrowth * mode.lambda.real());
}

}  // namespace
}  // namespace cosserat_cable
