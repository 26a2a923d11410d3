// Effects in the section laws against closed forms.

#include <gtest/gtest.h>

#include <complex>

#include "effects_fixture.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Complex = std::complex<double>;

// Time integration and the hundredth part of the disc that the cable's inertia is, squared.
constexpr double kPendulum = 1e-4;
// Laws are evaluated in double precision; the loops are sums of 1e4 of them.
constexpr double kLaw = 1e-10;
// Loops and moduli by trapezes of 1/2000 of a cycle.
constexpr double kCycle = 1e-3;
// Twelve thresholds against the integral over them: Gauss' rule is exact for the quadratic in them
// where all slip.
constexpr double kThresholds = 1e-3;
// The series' flatness that the library promises too.
constexpr double kFlat = 0.03;
// Statics of a slender rod: shear and the end's last element of precision.
constexpr double kStatic = 1e-6;
// Euler-Bernoulli against d/L = 1/150.
constexpr double kSlender = 2e-4;

/// Steps a section law through a curvature's history about a1, K(t) with its rate, and gives the
/// moments about a1.
VectorXd moments(Effect* effect, const VectorXd& K, const VectorXd& rate, double dt) {
  Points first = Points::Zero(3, 1), zero = first;
  first(0, 0) = K[0];
  effect->commit({0.0, true, first, zero}, nullptr);
  VectorXd result(K.size());
  for (int i = 0; i < K.size(); ++i) {
    Points k = zero, v = zero, M = zero;
    k(0, 0) = K[i];
    v(0, 0) = rate[i];
    const SectionState at{i * dt, false, k, v};
    effect->addMoments(at, &M);
    effect->commit(at, nullptr);
    result[i] = M(0, 0);
  }
  return result;
}

TEST(Relaxation, PendulumWithABranchDecaysByItsCharacteristicEquation) {
  Experiment e = pendulum(0.5, 1.5, 2e-3);
  const double L = e.cable.length, J = pendulumInertia(e), tau = 0.03, share = 0.3 * e.cable.GJ;
  e.effects = {{&kMaxwell, 1.0, {{"tau", tau}, {"EI", 0.0}, {"GJ", share}}}};
  const Record record = simulate(e);
  // J s^2 + (GJ + eta s + share tau s/(1 + tau s))/L = 0
  Complex s(-1.0, std::sqrt(e.cable.GJ / (L * J)));
  for (int i = 0; i < 200; ++i) {
    const Complex stiffness =
        (e.cable.GJ + e.cable.eta_GJ * s + share * tau * s / (1.0 + tau * s)) / (L * J);
    s = 0.5 * s + 0.5 * Complex(0.0, 1.0) * std::sqrt(stiffness);
  }
  // The branch's own, aperiodic decay is over after ten of its time constants.
  const VectorXd late = record.values.col(0).tail(e.times.size() - 150);
  const Complex measured = decayOf(late, 2e-3);
  EXPECT_NEAR(measured.imag() / s.imag(), 1.0, kPendulum);
  EXPECT_NEAR(measured.real() / s.real(), 1.0, 10.0 * kPendulum);
}

TEST(Relaxation, ConstantLossFactor) {
  const double loss = 0.06;
  for (double hertz : {0.5, 3.0, 20.0, 100.0}) {
    const auto effect = effectOf(kStructuralDamping, {{"loss_factor", loss}});
    const double w = 2.0 * std::acos(-1.0) * hertz;
    // Slow branches need cycles to forget the start; their mean stress is no loss, in phase with
    // nothing. Fewer steps in a cycle than in a step's order of accuracy would show.
    constexpr int kSteps = 60, kCycles = 8;
    const double dt = 2.0 * std::acos(-1.0) / w / kSteps;
    const VectorXd phase =
        VectorXd::LinSpaced(kSteps * kCycles + 1, 0.0, kSteps * kCycles * dt * w);
    const VectorXd K = phase.array().sin(), rate = w * phase.array().cos();
    const VectorXd M = moments(effect.get(), K, rate, dt) + effectCable().EI * K;
    const auto last = [&](const VectorXd& x) { return VectorXd(x.tail(kSteps)); };
    const double in = last(M).dot(last(phase).array().sin().matrix());
    const double out = last(M).dot(last(phase).array().cos().matrix());
    EXPECT_NEAR(out / in / loss, 1.0, kFlat) << hertz;
  }
}

TEST(SectionFriction, LoopAreaAndBackbone) {
  const double k = 2e-3, c = 0.8, spread = 0.5;
  const EffectValues values = {{"EI", k}, {"slip_curvature", c}, {"spread", spread}};
  const int n = 4000;
  const VectorXd phase = VectorXd::LinSpaced(2 * n + 1, 0.0, 4.0 * std::acos(-1.0));
  for (double amplitude : {0.3, 2.0, 5.0}) {
    const auto effect = effectOf(kSectionFriction, values);
    const VectorXd K = amplitude * phase.array().sin();
    const VectorXd M = moments(effect.get(), K, VectorXd::Zero(K.size()), 1e-3);
    double area = 0.0;
    for (int i = n + 1; i <= 2 * n; ++i) area += 0.5 * (M[i] + M[i - 1]) * (K[i] - K[i - 1]);
    // A Jenkins element of threshold y loses 4 k y (A - y); averaged over c (1 -+ spread).
    const double square = c * c * (1.0 + spread * spread / 3.0);
    const double exact = amplitude < c * (1.0 - spread) ? 0.0 : 4.0 * k * (c * amplitude - square);
    EXPECT_NEAR(area, exact, kThresholds * k * c * c) << amplitude;
    EXPECT_NEAR(M.maxCoeff(), k * std::min(amplitude, c), kThresholds * k * c) << amplitude;
  }
}

TEST(SectionFriction, SlipsInTheDirectionOfTheCurvature) {
  // Isotropic: the moment of a circle of curvature far beyond the threshold has the threshold's
  // size and lags behind by the angle whose sine is threshold over radius.
  const auto effect =
      effectOf(kSectionFriction, {{"EI", 1e-3}, {"slip_curvature", 0.5}, {"spread", 0.0}});
  const double radius = 2.0;
  Points K = Points::Zero(3, 1), M = K;
  const Points zero = K;
  effect->commit({0.0, true, K, zero}, nullptr);
  for (int i = 0; i <= 20000; ++i) {
    K.col(0) = radius * Vector3d(std::cos(1e-3 * i), std::sin(1e-3 * i), 0.0);
    M.setZero();
    effect->addMoments({0.0, false, K, zero}, &M);
    effect->commit({0.0, false, K, zero}, nullptr);
  }
  // The slider follows like a tractrix about a circle: perpendicular to its string's end.
  EXPECT_NEAR(M.norm(), 1e-3 * 0.5, 1e-12);
  const double along = M.col(0).dot(K.col(0)) / (M.norm() * radius);
  EXPECT_NEAR(along, 0.5 / radius, kCycle);
}

TEST(NonlinearStiffness, WorkIsTheEnergyOfTheContract) {
  const double x = -0.4, c = 1.5, EI = effectCable().EI;
  const auto effect = effectOf(kNonlinearStiffness, {{"change", x}, {"curvature", c}});
  const VectorXd K = VectorXd::LinSpaced(4001, 0.0, 3.0);
  const VectorXd M = moments(effect.get(), K, VectorXd::Zero(K.size()), 1e-3);
  double work = 0.0;
  for (int i = 1; i < K.size(); ++i) work += 0.5 * (M[i] + M[i - 1]) * (K[i] - K[i - 1]);
  const double k2 = 9.0;
  EXPECT_NEAR(work / (0.5 * EI * x * (k2 - c * c * std::log(1.0 + k2 / (c * c)))), 1.0, 1e-6);
}

TEST(Anisotropy, TwoFrequenciesInTheRatioOfTheStiffnesses) {
  const double d = 0.1, roll = 0.7;
  RodDynamics rod = weightlessRod();
  rod.addEffect(effectOf(kAnisotropy, {{"difference", d}, {"roll", roll}}));
  const auto modes = modesAbout(rod, VectorXd::Zero(rod.size()));
  EXPECT_NEAR(modes[1].imag() / modes[0].imag() / std::sqrt((1.0 + d) / (1.0 - d)), 1.0, kSlender);
  // A force across the stiff axis bends about it: no deflection beside the force.
  const double L = effectCable().length, force = 1e-4 * effectCable().EI / (L * L);
  rod.forces = {{L, force * Vector3d(std::sin(roll), -std::cos(roll), 0.0)}};
  const VectorXd q = loadedEquilibrium(rod), zero = VectorXd::Zero(rod.size());
  const Vector3d tip = rod.pointMotion({0.0, q, zero, zero}, rod.shape().integralTo(L)).position;
  const double compliance = L * L * L / (3.0 * effectCable().EI * (1.0 + d));
  EXPECT_NEAR(tip.x() / (force * compliance * std::sin(roll)), 1.0, kSlender);
  EXPECT_NEAR(tip.y() / (-force * compliance * std::cos(roll)), 1.0, kSlender);
}

TEST(RestCurvature, TheUnloadedRodIsAnArc) {
  const double k1 = 2.0, k2 = -1.5, size = std::hypot(k1, k2);
  RodDynamics rod = weightlessRod();
  rod.addEffect(effectOf(kRestCurvature, {{"k1", k1}, {"k2", k2}, {"twist", 0.0}}));
  const VectorXd q = loadedEquilibrium(rod), zero = VectorXd::Zero(rod.size());
  const double L = effectCable().length;
  const Vector3d tip = rod.pointMotion({0.0, q, zero, zero}, rod.shape().integralTo(L)).position;
  const double across = (1.0 - std::cos(size * L)) / size;
  EXPECT_NEAR(tip.z() / (std::sin(size * L) / size), 1.0, kStatic);
  EXPECT_NEAR(tip.x() / (across * k2 / size), 1.0, kStatic);
  EXPECT_NEAR(tip.y() / (-across * k1 / size), 1.0, kStatic);
}

TEST(BendTwistCoupling, TorqueBendsAndTwistsMore) {
  const double c1 = 0.3, c2 = -0.2;
  const CableData cable = effectCable();
  RodDynamics rod = weightlessRod();
  rod.addEffect(effectOf(kBendTwistCoupling, {{"c1", c1}, {"c2", c2}}));
  const double torque = 1e-5 * cable.GJ / cable.length;  // so small that nothing turns
  rod.end_torque = torque;
  const VectorXd q = loadedEquilibrium(rod);
  const double twist = rod.twist(q, rod.shape().integralTo(cable.length));
  const double exact = torque * cable.length / (cable.GJ * (1.0 - c1 * c1 - c2 * c2));
  EXPECT_NEAR(twist / exact, 1.0, 1e-4);
  const Points K = rod.shape().atNodes(q, 0);
  const double unit = std::sqrt(cable.GJ / cable.EI);
  EXPECT_NEAR(K(0, 3) / (-c1 * unit * K(2, 3)), 1.0, 1e-4);
  EXPECT_NEAR(K(1, 3) / (-c2 * unit * K(2, 3)), 1.0, 1e-4);
}

TEST(Drift, ChirpsThePendulum) {
  // WKB: phase is the integral of sqrt(GJ(t)/(J L)), amplitude falls as w^-1/2.
  Experiment e = pendulum(0.3, 2.0, 1e-3);
  const double change = 0.2, w = std::sqrt(e.cable.GJ / (e.cable.length * pendulumInertia(e)));
  e.effects = {{&kDrift, 1.0, {{"GJ", change}}}};
  const Record record = simulate(e);
  double worst = 0.0;
  for (int i = 0; i < e.times.size(); ++i) {
    const double x = e.times[i] / 2.0;
    const double phase = w * 2.0 * 2.0 / (3.0 * change) * (std::pow(1.0 + change * x, 1.5) - 1.0);
    const double decay = std::exp(-pendulumDecay(e) * e.times[i]);
    const double exact = 0.3 * decay * std::pow(1.0 + change * x, -0.25) *
                         (std::cos(phase) + pendulumDecay(e) / w * std::sin(phase));
    worst = std::max(worst, std::abs(record.values(i, 0) - exact));
  }
  // WKB neglects the rate over twice the frequency: w'/(4 w^2), and what the cable's inertia is
  // off.
  EXPECT_LT(worst, 0.3 * 5e-3);
}

}  // namespace
}  // namespace cosserat_cable::generator
