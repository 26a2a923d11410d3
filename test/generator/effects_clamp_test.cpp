// Effects at the clamps against closed forms.

#include <gtest/gtest.h>

#include <complex>

#include "effects_fixture.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr double kSlender = 2e-4;   // Euler-Bernoulli at d/L = 1/150
constexpr double kPendulum = 1e-4;  // the cable's third of its inertia at the disc
constexpr double kSmall = 1e-3;     // static deflections of 1e-3 lengths are linear to that

/// Bending frequency [rad/s] of a cantilever whose clamp is a rotation spring.
double hingedFrequency(double spring) {
  const CableData c = effectCable();
  const double r = spring * c.length / c.EI;
  // Deflection A (cosh - cos) + B sinh + C sin with w(0) = 0; moment and shear vanish at the end.
  const auto determinant = [r](double b) {
    Eigen::Matrix3d D;
    // Columns: cosh - cos, sinh, sin; rows: root EI w'' = k w', end moment, end shear.
    D << 2.0 * b * b, -r * b, -r * b,                            //
        std::cosh(b) + std::cos(b), std::sinh(b), -std::sin(b),  //
        std::sinh(b) - std::sin(b), std::cosh(b), -std::cos(b);
    return D.determinant();
  };
  const double b = root(determinant, 0.3, 1.95);
  return b * b * std::sqrt(c.EI / c.rhoA) / (c.length * c.length);
}

TEST(ClampCompliance, LowersTheFrequencyOfBending) {
  const double own = effectCable().EI / effectCable().length;
  for (double ratio : {2.0, 30.0}) {
    RodDynamics rod = weightlessRod();
    rod.addEffect(effectOf(kClampCompliance, {{"a.bending", ratio * own}}));
    EXPECT_EQ(rod.size(), rod.shape().size() + 2);
    const auto modes = modesAbout(rod, VectorXd::Zero(rod.size()));
    EXPECT_NEAR(modes[0].imag() / hingedFrequency(ratio * own), 1.0, kSlender);
    EXPECT_NEAR(modes[1].imag() / modes[0].imag(), 1.0, 1e-9);
  }
}

TEST(ClampCompliance, TheTangentIsTheDerivativeOfTheResidual) {
  RodDynamics rod(makeRod(effectCable()), {6, 5, 12});
  rod.forces = {{effectCable().length, Vector3d(0.05, 0.03, 0.02)}};
  rod.addEffect(effectOf(kClampCompliance, {{"a.bending", 0.1}, {"a.torsion", 0.1}}));
  const VectorXd q = loadedEquilibrium(rod), zero = VectorXd::Zero(rod.size());
  Eigen::MatrixXd M, D, K, difference(rod.size(), rod.size());
  rod.linearise(0.0, q, zero, zero, &M, &D, &K);
  for (int j = 0; j < rod.size(); ++j) {
    const VectorXd step = 1e-6 * VectorXd::Unit(rod.size(), j);
    difference.col(j) =
        (rod.residual(0.0, q + step, zero, zero) - rod.residual(0.0, q - step, zero, zero)) / 2e-6;
    EXPECT_LT((rod.residual(0.0, q, zero, VectorXd::Unit(rod.size(), j)) -
               rod.residual(0.0, q, zero, zero) - M.col(j))
                  .norm(),
              1e-9 * M.norm());
  }
  // The turn's Jacobian is left out of the derivative: of the order of the moment times the turn.
  EXPECT_LT((difference - K).topRows(rod.shape().size()).norm(), 1e-6 * K.norm());
  EXPECT_LT((difference - K).bottomRows(3).norm(), 0.3 * K.bottomRows(3).norm());
}

TEST(ClampCompliance, TorsionIsASpringInSeries) {
  Experiment e = pendulum(0.4, 1.0, 2e-3);
  const double k = 3.0 * e.cable.GJ / e.cable.length;
  e.effects = {{&kClampCompliance, 1.0, {{"a.torsion", k}, {"a.bending", 0.0}}}};
  const Record record = simulate(e);
  const double stiffness = 1.0 / (e.cable.length / e.cable.GJ + 1.0 / k);
  const double w = std::sqrt(stiffness / pendulumInertia(e));
  EXPECT_NEAR(record.values(0, 0), 0.4, 1e-8);
  EXPECT_NEAR(std::abs(decayOf(record.values.col(0), 2e-3)) / w, 1.0, 3.0 * kPendulum);
}

TEST(ClampDamping, PendulumWithADashpotBesideTheClampsSpring) {
  RodDynamics rod = weightlessRod();
  const Experiment e = pendulum(0.1, 1.0, 2e-3);
  const double k = 5.0 * e.cable.GJ / e.cable.length, c = 2e-3;
  rod.disc = *e.disc;
  rod.addEffect(effectOf(kClampCompliance, {{"a.torsion", k}}));
  rod.addEffect(effectOf(kClampDamping, {{"a.torsion", c}}));
  Complex s(0.0, 10.0);
  for (int i = 0; i < 200; ++i) {
    const Complex stiffness = 1.0 / (e.cable.length / e.cable.GJ + 1.0 / (k + c * s));
    s = 0.5 * s + Complex(0.0, 0.5) * std::sqrt(stiffness / pendulumInertia(e));
  }
  double nearest = 1.0;
  for (const Complex& mode : modesAbout(rod, VectorXd::Zero(rod.size())))
    nearest = std::min(nearest, std::abs(mode - s) / std::abs(s));
  EXPECT_LT(nearest, 3.0 * kPendulum);
}

TEST(ClampDamping, TheDiscsLossIsTheSourcePapers) {
  Experiment e = pendulum(0.4, 2.0, 2e-3);
  const double D_E = 3e-5;
  e.effects = {{&kClampDamping, 1.0, {{"b.torsion", D_E}}}};
  const Record record = simulate(e);
  const double delta = D_E / (2.0 * pendulumInertia(e)) + pendulumDecay(e);
  EXPECT_NEAR(-decayOf(record.values.col(0), 2e-3).real() / delta, 1.0, 2e-3);
}

TEST(ClampFriction, LoopAreaOfTheJenkinsElement) {
  const double stuck = 0.5, slip = 0.02, spring = 0.1, amplitude = 0.15;
  const auto effect =
      effectOf(kClampFriction, {{"a.stuck", stuck}, {"a.slip_moment", slip}, {"a.spring", spring}});
  const Points none = Points::Zero(3, 1);
  double area = 0.0, last_angle = 0.0, last = 0.0;
  constexpr int kSteps = 4000;
  for (int i = 0; i <= 2 * kSteps; ++i) {
    ClampTurn turns[2];
    turns[0].angle.y() = amplitude * std::sin(2.0 * std::acos(-1.0) * i / kSteps);
    Vector3d moment = Vector3d::Zero();
    effect->addClampMoment(0, turns[0], &moment);
    effect->commit({0.0, false, none, none}, turns);
    if (i > kSteps) area += 0.5 * (moment.y() + last) * (turns[0].angle.y() - last_angle);
    last = moment.y();
    last_angle = turns[0].angle.y();
  }
  EXPECT_NEAR(area / (4.0 * slip * (amplitude - slip / stuck)), 1.0, 1e-4);
}

TEST(ClampFriction, TakesWhatItsLoopTakesFromARingDown) {
  // Beyond slip an oscillator of one mode loses 4 m (psi - m/k) a cycle; from its energy K A^2/2
  // the amplitude falls along a straight line, dA a cycle.
  Experiment e = smallRingdown(0.1, 1.0, 1e-3);
  const double L = e.cable.length, own = e.cable.EI / L;
  const double spring = 10.0 * own, stuck = 1000.0 * own;
  const double moment = 3.0 * own * 0.1;  // at the clamp when let go
  const double slip = 0.02 * moment;
  e.effects = {
      {&kClampFriction, 1.0, {{"a.stuck", stuck}, {"a.slip_moment", slip}, {"a.spring", spring}}}};
  e.held = pulledEnd(e, Vector3d::UnitX(), 0.1 * L);
  const Record record = simulate(e);
  // Static tip displacement A needs force F = A/(L^3/3EI + L^2/spring); the clamp turns F L/spring.
  const double stiffness = 1.0 / (L * L * L / (3.0 * e.cable.EI) + L * L / spring);
  const double turn = stiffness * L / spring;  // over the displacement
  const double per_cycle = 4.0 * slip * turn / stiffness;
  const double period = 2.0 * std::acos(-1.0) / hingedFrequency(spring);
  // Amplitudes, as peaks of the tip, over the time between 10 % and 90 %.
  double first = 0.0, last = 0.0;
  int count = 0, first_at = 0, last_at = 0;
  const VectorXd x = record.values.col(0);
  for (int i = 120; i + 1 < x.size(); ++i) {
    if (x[i] > 0.0 && x[i] >= x[i - 1] && x[i] > x[i + 1] &&
        (count == 0 || (i - last_at) * 1e-3 > 0.7 * period)) {
      if (count == 0) first = x[i], first_at = i;
      last = x[i], last_at = i;
      ++count;
    }
  }
  ASSERT_GT(count, 4);
  const double cycles = (last_at - first_at) * 1e-3 / period;
  // The static shape stands for the mode's: moments of 12.36/12 and more, and higher modes sound.
  EXPECT_NEAR((first - last) / cycles / per_cycle, 1.0, 0.1);
}

TEST(ClampPlay, DeadZoneInStatics) {
  const CableData c = effectCable();
  const double L = c.length, gap = 0.02, k = 20.0 * c.EI / L;
  RodDynamics rod = weightlessRod();
  rod.addEffect(effectOf(kClampPlay, {{"a.gap", gap}, {"a.stiffness", k}}));
  const double force = 5e-2 * c.EI / (L * L);
  rod.forces = {{L, Vector3d(force, 0.0, 0.0)}};
  const VectorXd q = loadedEquilibrium(rod), zero = VectorXd::Zero(rod.size());
  const double tip = rod.pointMotion({0.0, q, zero, zero}, rod.shape().integralTo(L)).position.x();
  const double exact = force * L * L * L / (3.0 * c.EI) + L * (gap + force * L / k);
  EXPECT_NEAR(tip / exact, 1.0, 2.0 * kSmall);
}

}  // namespace
}  // namespace cosserat_cable::generator
