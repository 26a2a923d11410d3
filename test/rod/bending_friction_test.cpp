// Dry friction in a section, against the integrals of a Prandtl-Ishlinskii model whose thresholds
// are spread continuously: n(c') = k/(2 c w) over c (1 - w) .. c (1 + w).
#include "cosserat_cable/rod/bending_friction.h"

#include <gtest/gtest.h>

#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/point_loads.h"
#include "rod/ringing.h"
#include "rod/rod_cases.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 0.1, kEI = 0.01, kStick = 0.006, kSlip = 2.0;
constexpr int kElements = 10;
// Sixteen sliders for a continuum: the midpoint rule of c' (A - c') up to a kink at A, whose error
// is up to a quarter of the square of their distance by the kink.
constexpr double kSliders = 1.0 / (16 * 16);

RodModel FrictionRod(double spread, double eta_EI = 1e-7) {
  RodModel model = RoundCable(kLength, 0.004, 0.05, kEI, 0.008, eta_EI, eta_EI, kElements);
  model.gravity.setZero();
  model.laws.push_back(std::make_shared<BendingFriction>(kStick, kSlip, spread));
  return model;
}

/// The clamp at the end of an arc of the curvature `kappa` about the axis (cos phi, sin phi, 0).
Pose EndOfArc(double kappa, double phi) {
  const Vector3d axis(std::cos(phi), std::sin(phi), 0);
  const double angle = kappa * kLength;
  const double along = kappa == 0 ? kLength : std::sin(angle) / kappa;
  const double across = kappa == 0 ? 0 : (1 - std::cos(angle)) / kappa;
  return {along * Vector3d::UnitZ() + across * axis.cross(Vector3d::UnitZ()),
          Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis))};
}

/// What the friction carries at the end of a first bending to `kappa`, and what it dissipates in a
/// cycle of the amplitude `kappa`, per length.
double Backbone(double kappa, double w) {
  const double low = kSlip * (1 - w), high = kSlip * (1 + w), span = high - low;
  if (kappa <= low) return kStick * kappa;
  if (kappa >= high) return kStick * kSlip;
  return kStick / span * (0.5 * (kappa * kappa - low * low) + kappa * (high - kappa));
}
double LoopArea(double kappa, double w) {
  const double low = kSlip * (1 - w), high = std::min(kappa, kSlip * (1 + w));
  if (kappa <= low) return 0;
  const auto primitive = [&](double c) { return 0.5 * kappa * c * c - c * c * c / 3; };
  return 4 * kStick / (2 * kSlip * w) * (primitive(high) - primitive(low));
}

constexpr int kSteps = 400;
constexpr double kPeriod = 2;  // [s]; the rod's own waves are far above

struct Cycle {
  double top, area, dissipated, resting;  // moment [N m], per length [J/m], and without a loop
};
/// Bends a rod uniformly to and fro, slowly, three times; tells of the last.
Cycle Bend(double amplitude, double spread, double phi) {
  const RodModel model = FrictionRod(spread);
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, kLength, kElements));
  const Vector3d axis(std::cos(phi), std::sin(phi), 0);
  const Pose still;
  Cycle cycle{};
  double before = 0, moment = 0, kappa = 0, turn = 0;
  for (int k = 1; k <= 3 * kSteps; ++k) {
    if (k == 2 * kSteps + 1) before = rod.energy_balance().dissipated;
    const double next = amplitude * std::sin(2 * M_PI * k / kSteps);
    EXPECT_TRUE(rod.Step(kPeriod / kSteps, still, EndOfArc(next, phi)).converged);
    const double m = rod.moment(kElements / 2).dot(axis);
    if (k > 2 * kSteps) cycle.area += 0.5 * (m + moment) * (next - kappa);
    if (k == 2 * kSteps + kSteps / 4) cycle.top = m;
    moment = m;
    kappa = next;
    turn = std::max(turn, rod.moment(kElements / 2).cross(axis).norm());
  }
  EXPECT_LT(turn, 1e-6);  // it bends about no other axis
  cycle.dissipated = (rod.energy_balance().dissipated - before) / kLength;
  return cycle;
}

TEST(BendingFrictionTest, ALoopHasTheAreaOfAPrandtlIshlinskiiModel) {
  for (const double spread : {0.5, 1.0})
    for (const double amplitude : {0.8, 1.4, 2.2, 3.0, 6.0}) {
      const Cycle cycle = Bend(amplitude, spread, 0.3 * amplitude);
      // And the viscosity, which is 1e-5 of EI at this frequency.
      const double area = LoopArea(amplitude, spread);
      const double within = kSliders * kStick * amplitude * kSlip * spread + 1e-4 * kEI * amplitude;
      EXPECT_NEAR(cycle.area, area, within) << spread << " " << amplitude;
      EXPECT_NEAR(cycle.dissipated, area, within) << spread << " " << amplitude;
      const double top = kEI * amplitude + Backbone(amplitude, spread);
      EXPECT_NEAR(cycle.top, top, 1e-3 * top) << spread << " " << amplitude;
      if (spread != 0.5 || (amplitude != 1.4 && amplitude != 3)) continue;
      const std::string at = " at the curvature " + Shown(amplitude) + "/m ";
      const char* source = "integral of Prandtl and Ishlinskii";
      Validate({"Causes", "section_friction: loss in a cycle" + at + "[J/m]", source, area,
                cycle.dissipated, within, kElements, kPeriod / kSteps});
      Validate({"Causes", "section_friction: moment of first bending" + at + "[N m]", source, top,
                cycle.top, 1e-3 * top, kElements, kPeriod / kSteps});
    }
}

TEST(BendingFrictionTest, OfSmallAmplitudesTheLossGoesWithTheCube) {
  // Thresholds from zero on: k A^3/(3 c) where no slider is beyond the largest.
  for (const double amplitude : {1.0, 2.0, 4.0})
    EXPECT_NEAR(LoopArea(amplitude, 1), kStick * std::pow(amplitude, 3) / (3 * kSlip),
                1e-12);  // the closed form itself
  const double small = Bend(1, 1, 0).dissipated, large = Bend(2, 1, 0).dissipated;
  EXPECT_NEAR(large / small, 8, 0.2);  // the sliders' 4e-3 of the smaller amplitude, twice
}

TEST(BendingFrictionTest, BelowTheLeastThresholdAllStick) {
  const Cycle cycle = Bend(0.95, 0.5, 0.4);  // of 1, rounded to the first slider's 1.06
  EXPECT_NEAR(cycle.area, 0, 1e-4 * kEI);
  EXPECT_NEAR(cycle.dissipated, 0, 1e-4 * kEI);
  EXPECT_NEAR(cycle.top, (kEI + kStick) * 0.95, 1e-4 * kEI);
}

/// Cantilever, pulled across by a force at its tip.
Rod Pulled(const RodModel& clamped, double force) {
  RodModel model = clamped;
  model.b = EndModel::Free();
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, kLength, kElements));
  const PointLoads load(kLength, {{kLength, {force, 0, 0}}});
  EXPECT_TRUE(rod.Equilibrate(&load).converged);
  return rod;
}

TEST(BendingFrictionTest, PureBendingFollowsTheBackbone) {
  constexpr double kRelative = 1e-3;  // sixteen sliders
  for (const double moment : {0.004, 0.02, 0.03, 0.06}) {
    RodModel model = FrictionRod(0.8);
    model.b = EndModel::Free();
    Rod rod(model);
    rod.SetConfiguration(StraightShape(Pose{}, kLength, kElements));
    PointLoads load(kLength, {{kLength, Vector3d::Zero(), {0.6 * moment, 0.8 * moment, 0}}});
    load.loads[0].follower = true;
    ASSERT_TRUE(rod.Equilibrate(&load).converged);
    for (const int e : {0, kElements - 1}) {
      const double kappa = rod.curvature(e).norm();
      EXPECT_NEAR(kEI * kappa + Backbone(kappa, 0.8), moment, kRelative * moment);
      EXPECT_NEAR(rod.moment(e).norm(), moment, 1e-9);
    }
  }
}

TEST(BendingFrictionTest, SmallVibrationsSeeAllStick) {
  // What of an element bends between its nodes does so with EI alone: (1/10)^2 of the friction's
  // part.
  constexpr double kRelative = 2e-3;
  const RodModel model = FrictionRod(0.5, 0);
  RodModel stuck = model;
  stuck.laws.clear();
  stuck.section.C_M.x() = stuck.section.C_M.y() = kEI + kStick;
  const double expected = FindModes(Pulled(stuck, 0), 1).front().w;
  EXPECT_NEAR(FindModes(Pulled(model, 0), 1).front().w, expected, kRelative * expected);

  // The root's curvature is 0.02 of the least threshold.
  Rod rod = Pulled(model, 0.02 * kSlip * 0.5 * (kEI + kStick) / kLength);
  std::vector<double> tip;
  for (int k = 0; k < 400; ++k) {
    ASSERT_TRUE(rod.Step(1e-4, Pose{}, Pose{}).converged);
    tip.push_back(rod.pose(kElements).p.x());
  }
  EXPECT_NEAR(Listen(tip, 1e-4).w(), expected, 2 * kRelative * expected);
}

TEST(BendingFrictionTest, LargeVibrationsAreSlowerAndDecayToSmallOnes) {
  const RodModel model = FrictionRod(1.0, 0);
  // The root's curvature is five times the largest threshold.
  Rod rod = Pulled(model, 10 * kSlip * kEI / kLength);
  std::vector<double> tip;
  constexpr double kDt = 1e-4;
  for (int k = 0; k < 6000; ++k) {
    ASSERT_TRUE(rod.Step(kDt, Pose{}, Pose{}).converged) << k;
    tip.push_back(rod.pose(kElements).p.x());
  }
  const Ringing first = Listen({tip.begin(), tip.begin() + 900}, kDt);
  const Ringing last = Listen({tip.end() - 900, tip.end()}, kDt);
  EXPECT_GT(last.w(), 1.02 * first.w());
  EXPECT_LT(last.w(), std::sqrt(1 + kStick / kEI) * first.w());
  EXPECT_LT(last.delta, 0.5 * first.delta);  // of thresholds from zero on, the loss goes to zero
}

}  // namespace
}  // namespace cosserat_cable::rod
