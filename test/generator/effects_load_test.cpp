// Effects that load the rod, against closed forms.

#include <gtest/gtest.h>

#include "effects_fixture.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// Euler-Bernoulli against d/L = 1/150.
constexpr double kSlender = 2e-4;
// Time integration.
constexpr double kDecay = 1e-3;

/// First mode of a clamped-free beam, 1 at the tip, at x in lengths.
double firstMode(double x) {
  const double b = 1.8751040687119611, ratio = 0.7340955137589125;
  return 0.5 * (std::cosh(b * x) - std::cos(b * x) - ratio * (std::sinh(b * x) - std::sin(b * x)));
}

/// Mean over the length of the mode's power.
double meanPower(int power) {
  constexpr int kParts = 4000;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) sum += std::pow(firstMode((i + 0.5) / kParts), power);
  return sum / kParts;
}

TEST(ExternalDamping, EveryModeDecaysAtHalfTheRate) {
  RodDynamics rod = weightlessRod();
  const double rate = 0.7;
  rod.addEffect(effectOf(kExternalDamping, {{"rate", rate}}));
  const auto modes = modesAbout(rod, VectorXd::Zero(rod.size()));
  for (int i : {0, 2, 4}) {
    // Rotary inertia has no part in the drag: (mu d/(4 L))^2 of it, less for lower modes.
    EXPECT_NEAR(-modes[i].real() / (0.5 * rate), 1.0, 2.0 * kSlender) << i;
  }
}

TEST(AirDrag, OneOverAmplitudeIsLinearInTime) {
  // Energy lost in a cycle at the first mode, by its shape's mean cube:
  // d(1/A)/dt = 2/(3 pi) rho Cd d w <phi^3>/(rhoA <phi^2>).
  const double Cd = 60.0, amplitude = 0.05;
  Experiment e = smallRingdown(amplitude, 1.2, 1e-3);
  e.cable.eta_EI = 1e-5;  // takes the higher modes of the release
  const Record plain = simulate(e);
  e.effects = {{&kAirDrag, 1.0, {{"Cd", Cd}}}};
  const Record record = simulate(e);
  const auto envelope = [](const VectorXd& x, int from, int to) {
    double largest = 0.0;
    for (int i = from; i < to; ++i) largest = std::max(largest, std::abs(x[i]));
    return largest;
  };
  const double w = 1.8751040687119611 * 1.8751040687119611 * std::sqrt(e.cable.EI / e.cable.rhoA) /
                   (e.cable.length * e.cable.length);
  const int period = static_cast<int>(std::lround(2000.0 * std::acos(-1.0) / w));
  const int late = 1200 - period - 1, early = 2 * period;
  const VectorXd with = record.values.col(0), without = plain.values.col(0);
  // What the other losses take is taken out of it: they multiply.
  const double own =
      envelope(without, late, late + period) / envelope(without, early, early + period);
  const double slope =
      (own / envelope(with, late, late + period) - 1.0 / envelope(with, early, early + period)) /
      ((late - early) * 1e-3);
  const double exact = 2.0 / (3.0 * std::acos(-1.0)) * 1.204 * Cd * e.cable.diameter * w *
                       meanPower(3) / (e.cable.rhoA * meanPower(2));
  // Envelopes by samples, higher modes of the release (3 %), and the amplitude over which they act.
  EXPECT_NEAR(slope / exact, 1.0, 0.05);
}

TEST(AddedMass, AtTheEnd) {
  CableData c = effectCable();
  const double ratio = 0.3;
  effectOf(kAddedMass, {{"s", c.length}, {"mass", ratio * c.rhoA * c.length}})->equip(&c);
  ASSERT_EQ(c.masses.size(), 1u);
  RodDynamics rod = weightlessRod(c);
  const double w = modesAbout(rod, VectorXd::Zero(rod.size()))[0].imag();
  const double exact =
      std::sqrt(3.0 * c.EI / (std::pow(c.length, 3) * c.rhoA * c.length * (ratio + 33.0 / 140.0)));
  EXPECT_NEAR(w / exact, 1.0, 3e-3);  // Rayleigh's quotient of the static shape is from above
  CableData shorter = effectCable();
  effectOf(kAddedMass, {{"s", 2.0 * c.length}, {"mass", 1.0}})->equip(&shorter);
  EXPECT_TRUE(shorter.masses.empty());
}

/// Tip deflection [m] along -x under a force there, with a plane that fills x < offset.
double pressedTip(double force, const EffectValues& values) {
  const CableData c = effectCable();
  RodDynamics rod = weightlessRod();
  rod.addEffect(effectOf(kContact, values));
  rod.forces = {{c.length, Vector3d(-force, 0.0, 0.0)}};
  const VectorXd q = loadedEquilibrium(rod), zero = VectorXd::Zero(rod.size());
  return rod.pointMotion({0.0, q, zero, zero}, rod.shape().integralTo(c.length)).position.x();
}

TEST(Contact, SetsInWhereTheSurfaceTouches) {
  const CableData c = effectCable();
  const double stop = 0.01, radius = 0.5 * c.diameter;
  const double onset = 3.0 * c.EI / std::pow(c.length, 3) * stop;
  const double unit = std::pow(c.length, 3) / (3.0 * c.EI);
  const EffectValues plane = {{"plane.azimuth", 0.0},
                              {"plane.elevation", 0.0},
                              {"plane.offset", -stop - radius},
                              {"stiffness", 2e4}};
  EXPECT_NEAR(pressedTip(0.98 * onset, plane), -0.98 * onset * unit, 3e-3 * stop);
  // Beyond, the tip stays where it is: within a few tenths of a millimetre, twice the parabola's.
  EXPECT_NEAR(pressedTip(2.0 * onset, plane), -stop, 3e-4);
  // A peg across, under the tip's place, does the same.
  const EffectValues peg = {{"peg.x", -stop - radius - 0.02},
                            {"peg.z", 0.99 * c.length},
                            {"peg.azimuth", std::acos(0.0)},
                            {"peg.radius", 0.02},
                            {"stiffness", 2e4}};
  EXPECT_NEAR(pressedTip(0.9 * onset, peg), -0.9 * onset * unit, 1e-2 * stop);
  EXPECT_NEAR(pressedTip(2.0 * onset, peg), -stop, 6e-4);
}

TEST(Contact, MovesWithTheClamp) {
  const auto contact = effectOf(kContact, {{"plane.offset", 0.0}, {"stiffness", 1e4}});
  FrameMotion clamp;
  clamp.p = Vector3d(1.0, 2.0, 3.0);
  clamp.R = Eigen::AngleAxisd(std::acos(0.0), Vector3d::UnitZ()).toRotationMatrix();
  const VectorXd s = VectorXd::Constant(1, 0.1);
  Points position = clamp.p + Vector3d(0.05, -0.002, 0.0), zero = Points::Zero(3, 1);
  Points tangent = Vector3d::UnitZ(), force = zero;
  // The plane's normal is the world's y now.
  contact->addForces({0.0, s, position, zero, tangent, clamp}, &force);
  EXPECT_NEAR(force(1, 0), 1e4 * 40.0 / effectCable().length * (0.002 + 0.001 - 5e-5), 1e-6);
  EXPECT_NEAR(force(0, 0), 0.0, 1e-9);
}

}  // namespace
}  // namespace cosserat_cable::generator
