// Laws that no cause of the library stands for, against closed forms.

#include <gtest/gtest.h>

#include "../effects_fixture.h"
#include "../noise.h"
#include "kinds.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kTimeSteps = 2e-3;  // of the integrator, over a second

double angularFrequency(const CableData& c) {
  return 1.8751040687119611 * 1.8751040687119611 * std::sqrt(c.EI / c.rhoA) / (c.length * c.length);
}

/// Tip of a small ring-down with this law, without gravity.
VectorXd swing(const EffectKind& kind, const EffectValues& values, double dt = 1e-3) {
  Experiment e = smallRingdown(0.02, 1.2, dt);
  e.cable.eta_EI = 1e-5;  // takes the higher modes of the release
  e.effects = {{&kind, 1.0, values}};
  return simulate(e).values.col(0);
}

TEST(OutsideLaws, AllLeaveThePlainRodAtSizeZero) {
  EffectScale scale;
  scale.cable = effectCable();
  scale.frequency = scale.torsion = angularFrequency(scale.cable);
  Experiment e = smallRingdown(0.02, 0.2, 1e-3);
  const VectorXd plain = simulate(e).values.col(0);
  for (const EffectKind* kind : outsideKinds()) {
    e.effects = {{kind, 0.0, kind->defaults(scale, 0.0)}};
    const VectorXd x = simulate(e).values.col(0);
    EXPECT_LT((x - plain).cwiseAbs().maxCoeff(), 1e-5 * plain.cwiseAbs().maxCoeff()) << kind->name;
  }
}

TEST(OutsideLaws, AStrandOnStiffSpringsIsSoMuchMass) {
  // Far below its own frequency the strand goes with the rod.
  const CableData c = effectCable();
  const double part = 0.1, w = angularFrequency(c);
  const VectorXd x =
      swing(kCoupledStrand, {{"mass", part * c.rhoA}, {"frequency", 30.0 * w}, {"ratio", 0.1}});
  Experiment heavy = smallRingdown(0.02, 1.2, 1e-3);
  heavy.cable.eta_EI = 1e-5;
  const double plain = decayOf(simulate(heavy).values.col(0).tail(900), 1e-3).imag();
  const double loaded = decayOf(x.tail(900), 1e-3).imag();
  // (w/30w)^2 more inertia than at rest.
  EXPECT_NEAR(plain / loaded, std::sqrt(1.0 + part * (1.0 + 1.0 / 900.0)), kTimeSteps);
}

TEST(OutsideLaws, ASlugThatRestsNearTheEndIsAPointMass) {
  // A period so long that it stays where its phase has it.
  const CableData c = effectCable();
  const double mass = 0.3 * c.rhoA * c.length, w = angularFrequency(c);
  double s = 0.0, seed = 0.0;
  while (s < 0.8 * c.length) {
    generator::Random random(static_cast<std::uint64_t>(++seed));
    random.uniform(0.7, 1.4);
    s = c.length * (0.5 - 0.38 * std::cos(random.uniform(0.0, 6.28)));
  }
  const EffectValues values = {
      {"mass", mass}, {"period", 1e6}, {"frequency", 30.0 * w}, {"seed", seed}};
  Experiment e = smallRingdown(0.02, 1.2, 1e-3);
  e.cable.eta_EI = 1e-5;
  e.gravity = {0.0, 0.0, -9.81};  // the slug has weight: so has the point mass
  e.effects = {{&kMovingSlug, 1.0, values}};
  const double slug = decayOf(simulate(e).values.col(0).tail(900), 1e-3).imag();
  e.effects = {{&kAddedMass, 1.0, {{"s", s}, {"mass", mass}}}};
  const double point = decayOf(simulate(e).values.col(0).tail(900), 1e-3).imag();
  e.effects.clear();
  const double plain = decayOf(simulate(e).values.col(0).tail(900), 1e-3).imag();
  // The slug goes with the mean of a piece of a fifth of the length: shape of a bent cantilever.
  double mean = 0.0;
  const auto shape = [](double x) { return 0.5 * x * x * (3.0 - x); };
  for (int i = 0; i < 1000; ++i) {
    const double x = (i + 0.5) / 500.0 - 1.0;
    mean += 0.75 * (1.0 - x * x) * shape(s / c.length + 0.1 * x) / 500.0;
  }
  const double spread = std::pow(mean / shape(s / c.length), 2);
  const auto inertia = [plain](double loaded) { return plain * plain / (loaded * loaded) - 1.0; };
  EXPECT_NEAR(inertia(slug) / inertia(point), spread, 0.03);
}

TEST(OutsideLaws, SlipSoftensByItsLoss) {
  // Switches once at once, then hardly ever: EI (1 - loss) from the start.
  const double loss = 0.1;
  CableData c = effectCable();
  const auto effect =
      effectOf(kIntermittentSlip, {{"loss", loss}, {"rate", 3.0}, {"seed", 5.0}}, 10.0);
  Points K = Points::Constant(3, 1, 2.0), Kd = Points::Zero(3, 1);
  double least = 1.0, most = -1.0;
  for (int i = 0; i < 10000; ++i) {
    Points M = Points::Zero(3, 1);
    effect->addMoments({i * 1e-3, false, K, Kd}, &M);
    EXPECT_EQ(M(2, 0), 0.0);
    least = std::min(least, M(0, 0) / (2.0 * c.EI));
    most = std::max(most, M(0, 0) / (2.0 * c.EI));
  }
  EXPECT_NEAR(least, -loss, 1e-9);
  EXPECT_NEAR(most, 0.0, 1e-9);
}

TEST(OutsideLaws, AMagnetPullsTheEndTowardsIt) {
  const CableData c = effectCable();
  const double force = 1e-3, reach = 0.1 * c.length;
  // At a distance of reach the force is the largest; small against the rod's stiffness.
  RodDynamics rod = weightlessRod();
  rod.addEffect(effectOf(kMagnet, {{"force", force}, {"x", reach}, {"y", 0.0}, {"reach", reach}}));
  const VectorXd q = loadedEquilibrium(rod), zero = VectorXd::Zero(q.size());
  const double tip =
      rod.pointMotion({0.0, q, zero, zero}, rod.shape().integralTo(c.length)).position.x();
  // A force at a of the length bends the end by F a^2 (3 - a) L^3/(6 EI); the magnet's acts on a
  // piece about 0.9 L.
  const double a = 0.9, exact = force * a * a * (3.0 - a) * std::pow(c.length, 3) / (6.0 * c.EI);
  EXPECT_NEAR(tip / exact, 1.0, 0.01);
}

TEST(OutsideLaws, TapsBringTheirMomentum) {
  // On a rod at rest, and before it springs back: momentum over mass moves the centre.
  const CableData c = effectCable();
  const double momentum = 1e-4;
  const auto effect = effectOf(
      kRandomTaps, {{"s", 0.6}, {"momentum", momentum}, {"rate", 2.5}, {"seed", 3.0}}, 4.0);
  const int stations = 200;
  const VectorXd s = VectorXd::LinSpaced(stations, 0.0, c.length);
  Points zero = Points::Zero(3, stations);
  const FrameMotion clamp;
  Vector3d pushed = Vector3d::Zero();
  double sum = 0.0;
  int taps = 0;
  for (int i = 0; i < 40000; ++i) {
    Points force = Points::Zero(3, stations);
    effect->addForces({i * 1e-4, s, zero, zero, zero, clamp}, &force);
    const Vector3d total = force.rowwise().sum() * c.length / (stations - 1);
    if (total.norm() > 0.0 && pushed.norm() == 0.0) ++taps;
    pushed = total;
    sum += total.norm() * 1e-4;
  }
  EXPECT_GT(taps, 0);
  EXPECT_GT(sum / taps, 0.45 * momentum);
  EXPECT_LT(sum / taps, 1.55 * momentum);
}

TEST(OutsideLaws, ASupportBrakesLessTheFasterItRubs) {
  const auto effect =
      effectOf(kStribeckSupport,
               {{"s", 0.5}, {"slow", 1.0}, {"stick", 3.0}, {"falls", 0.1}, {"onset", 0.01}});
  const int stations = 400;
  const double L = effectCable().length;
  const VectorXd s = VectorXd::LinSpaced(stations, 0.0, L);
  const FrameMotion clamp;
  const Points place = Points::Zero(3, stations);
  const auto braked = [&](double speed) {
    Points velocity = Points::Zero(3, stations), force = velocity;
    velocity.row(1).setConstant(speed);
    effect->addForces({0.0, s, place, velocity, place, clamp}, &force);
    return -force.row(1).sum() * L / (stations - 1);
  };
  EXPECT_NEAR(braked(0.03), (1.0 + 2.0 * std::exp(-0.09)) * std::tanh(3.0), 0.01);
  EXPECT_NEAR(braked(1.0), 1.0, 0.01);
  EXPECT_NEAR(braked(-1.0), -1.0, 0.01);
}

TEST(OutsideLaws, AThreadThatPullsRaisesTheFrequency) {
  const CableData c = effectCable();
  const auto frequency = [&](double tension) {
    RodDynamics rod = weightlessRod();
    rod.addEffect(
        effectOf(kParametricTension, {{"tension", tension}, {"frequency", 1.0}, {"seed", 1.0}}));
    generator::Random random(1);
    const double t = 0.5 / random.uniform(0.5, 1.5);  // where it is at its largest
    const VectorXd q = VectorXd::Zero(rod.size());
    MotionState state{t, q, q, q};
    Eigen::MatrixXd M, D, K;
    rod.linearise(t, q, q, q, &M, &D, &K);
    const Eigen::MatrixXd A = M.partialPivLu().solve(K);
    return std::sqrt(A.eigenvalues().real().minCoeff());
  };
  const double unit = c.EI / (c.length * c.length);
  EXPECT_GT(frequency(0.5 * unit), 1.05 * frequency(0.0));
  EXPECT_LT(frequency(-0.5 * unit), 0.95 * frequency(0.0));
}

TEST(OutsideLaws, EddiesBrakeWhereTheMagnetIs) {
  const auto effect = effectOf(
      kEddyDamping, {{"rate", 2.0}, {"from", 0.5}, {"x", 0.1}, {"y", 0.0}, {"reach", 0.02}});
  const CableData c = effectCable();
  const VectorXd s = (VectorXd(3) << 0.4 * c.length, 0.6 * c.length, 0.9 * c.length).finished();
  Points place = Points::Zero(3, 3), velocity = place, force = place;
  place.row(0) << 0.1, 0.1, 0.12;
  velocity.row(0).setOnes();
  const FrameMotion clamp;
  effect->addForces({0.0, s, place, velocity, place, clamp}, &force);
  EXPECT_EQ(force(0, 0), 0.0);
  EXPECT_NEAR(force(0, 1), -2.0 * c.rhoA, 1e-12);
  EXPECT_NEAR(force(0, 2), -2.0 * c.rhoA * std::exp(-0.5), 1e-12);
}

}  // namespace
}  // namespace cosserat_cable::generator
