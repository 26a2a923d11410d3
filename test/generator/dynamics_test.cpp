// Motion of the generator's rod over time: statics to start from, decay, energy, convergence.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "oscillation.h"
#include "rigs.h"
#include "statics.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Quantity = Channel::Quantity;

// What time integration at the default tolerance may add to a frequency and to a damping: a
// hundredth of what 40 dB of noise leaves uncertain over thirty periods.
constexpr double kFrequency = 1e-6;
constexpr double kDamping = 2e-4;
// Default accuracy against a far finer run, rms relative to the signal's: at 40 dB noise is 1e-2 of
// it, and 3000 samples show a systematic error of 1e-2/sqrt(3000). Velocities stay below that.
// Positions, in which the wave that the release sends out counts less by its frequency over that of
// the swing, some six, stay below that part of it.
const double kVisible = 1e-2 / std::sqrt(3000.0);
const double kConverged = kVisible / 6.0;
// The printed values have five digits.
constexpr double kElastica = 1e-5;
constexpr double kEnergy = 1e-6;

CableData cable() {
  CableData c;
  c.length = 0.2;
  c.diameter = 8e-3;
  c.rhoA = 0.09;
  c.EI = 0.012;
  c.GJ = 0.009;
  c.eta_EI = 2.0 * 0.01 * c.EI / 32.1;  // a damping ratio of 0.01
  c.eta_GJ = 1e-5;
  return c;
}

VectorXd evenTimes(double duration, double dt) {
  const int count = static_cast<int>(std::lround(duration / dt)) + 1;
  return VectorXd::LinSpaced(count, 0.0, duration);
}

Experiment horizontalRingdown(double amplitude, double duration) {
  Experiment e;
  e.cable = cable();
  e.a.R << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // a3 along x
  e.held = pulledEnd(e, {0.0, 0.5, 1.0}, amplitude * e.cable.length);
  for (int axis = 0; axis < 3; ++axis) {
    e.channels.push_back({"tip", e.cable.length, Quantity::kPosition, axis});
    e.channels.push_back({"middle", 0.45 * e.cable.length, Quantity::kVelocity, axis});
  }
  e.times = evenTimes(duration, 1e-3);
  return e;
}

TEST(Statics, Elastica) {
  const double loads[] = {1.0, 2.0, 5.0, 10.0};
  const double w[] = {0.30172, 0.49346, 0.71379, 0.81061};
  const double u[] = {0.05643, 0.16064, 0.38763, 0.55500};
  CableData c = cable();
  c.diameter = 1e-4;  // neither shear nor stretch
  for (int i = 0; i < 4; ++i) {
    RodDynamics rod(makeRod(c), Resolution());
    rod.gravity.setZero();
    rod.forces = {{c.length, Vector3d(loads[i] * c.EI / (c.length * c.length), 0.0, 0.0)}};
    const VectorXd q = loadedEquilibrium(rod), zero = VectorXd::Zero(q.size());
    const Vector3d tip =
        rod.pointMotion({0.0, q, zero, zero}, rod.shape().integralTo(c.length)).position / c.length;
    EXPECT_NEAR(tip.x(), w[i], kElastica) << loads[i];
    EXPECT_NEAR(1.0 - tip.z(), u[i], kElastica) << loads[i];
  }
}

TEST(Statics, HeldWhereAForcePulledIt) {
  Experiment e = horizontalRingdown(0.4, 0.1);
  RodDynamics rod = makeRig(e, Resolution());
  const VectorXd rest = loadedEquilibrium(rod), zero = VectorXd::Zero(rest.size());
  const VectorXd q = heldEquilibrium(rod, rest, e.cable.length, *e.held);
  const Vector3d tip =
      rod.pointMotion({0.0, q, zero, zero}, rod.shape().integralTo(e.cable.length)).position;
  EXPECT_LT((tip - *e.held).norm(), 1e-10 * e.cable.length);
  const Vector3d force = rod.forces.back().second;
  EXPECT_LT(force.cross(Vector3d(0.0, 0.5, 1.0)).norm(), 1e-6 * force.norm());
}

TEST(Dynamics, TangentIsTheDerivativeOfTheResidual) {
  Experiment e = horizontalRingdown(0.3, 0.1);
  e.cable.masses = {{0.12, 0.01}};
  RodDynamics rod = makeRig(e, {6, 5, 12});
  rod.forces = {{e.cable.length, Vector3d(0.1, 0.3, -0.2)}};
  const VectorXd q = loadedEquilibrium(rod), zero = VectorXd::Zero(rod.size());
  Eigen::MatrixXd M, D, K, difference(rod.size(), rod.size());
  rod.linearise(0.0, q, zero, zero, &M, &D, &K);
  for (int j = 0; j < rod.size(); ++j) {
    const VectorXd step = 1e-5 * VectorXd::Unit(rod.size(), j);
    difference.col(j) =
        (rod.residual(0.0, q + step, zero, zero) - rod.residual(0.0, q - step, zero, zero)) / 2e-5;
    EXPECT_LT((rod.residual(0.0, q, zero, VectorXd::Unit(rod.size(), j)) -
               rod.residual(0.0, q, zero, zero) - M.col(j))
                  .norm(),
              1e-9 * M.norm());
  }
  EXPECT_LT((difference - K).norm(), 1e-7 * K.norm());
  EXPECT_LT((M - M.transpose()).norm(), 1e-12 * M.norm());
}

TEST(Dynamics, SmallRingDownDecaysLikeItsMode) {
  Experiment e = horizontalRingdown(1e-4, 3.0);
  e.channels = {{"tip_z", e.cable.length, Quantity::kPosition, 2}};
  e.times = evenTimes(3.0, 5e-3);
  e.gravity.setZero();
  e.held = pulledEnd(e, Vector3d::UnitZ(), 1e-4 * e.cable.length);
  RodDynamics rod = makeRig(e, Resolution());
  const std::complex<double> mode = modesAbout(rod, VectorXd::Zero(rod.size()))[0];
  const Record record = simulate(e);
  // After a second the second mode is gone: it decays forty times as fast.
  const VectorXd late = record.values.col(0).tail(e.times.size() - 200).array() - record.rest[0];
  const std::complex<double> measured = decayOf(late, 5e-3);
  RecordProperty("frequency_error", std::to_string(measured.imag() / mode.imag() - 1.0));
  EXPECT_NEAR(measured.imag() / mode.imag(), 1.0, kFrequency);
  EXPECT_NEAR(measured.real() / mode.real(), 1.0, kDamping);
}

TEST(Dynamics, TorsionDecaysAsTheClosedForm) {
  Experiment e;
  e.cable = cable();
  e.cable.eta_GJ = 2e-6;
  e.a.R = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  const Rod rod = makeRod(e.cable);
  const double L = e.cable.length;
  for (bool guided : {false, true}) {
    Disc disc;
    disc.inertia = 1e-4;
    disc.mass = 0.1;
    disc.dashpot = 2e-5;
    e.disc = disc;
    e.guided = guided;
    e.twisted = 1.0;
    e.channels = {{"angle", L, Quantity::kAngle, 2}, {"rate", L, Quantity::kRate, 2}};
    e.times = evenTimes(3.0, 5e-3);
    const Record record = simulate(e);
    EXPECT_NEAR(record.values(0, 0), 1.0, 1e-9);
    const std::complex<double> measured = decayOf(record.values.col(0), 5e-3);
    const double J = disc.inertia + rod.rhoJ[2] * L / 3.0;
    const double square = e.cable.GJ / (L * J);
    const double delta = (e.cable.eta_GJ / L + disc.dashpot) / (2.0 * J);
    // A third of the cable's own inertia is good to the square of its share, here 1e-3.
    EXPECT_NEAR(std::norm(measured) / square, 1.0, 2.0 * kFrequency);
    EXPECT_NEAR(-measured.real() / delta, 1.0, kDamping);
  }
}

TEST(Dynamics, EnergyIsLostToViscosityAlone) {
  const Experiment e = horizontalRingdown(0.5, 0.25);
  RodDynamics rod = makeRig(e, Resolution());
  const VectorXd rest = loadedEquilibrium(rod), zero = VectorXd::Zero(rest.size());
  const VectorXd q = heldEquilibrium(rod, rest, e.cable.length, *e.held);
  rod.forces.clear();
  RadauOptions options;
  options.tolerance = 1e-8;
  double lost = 0.0, start = 0.0, end = 0.0;
  integrateRadau(rod, q, zero, 0.0, 0.25, options, [&](const MotionState& a, const MotionState& b) {
    const double h = b.t - a.t;
    MotionState middle{
        0.5 * (a.t + b.t),
        0.5 * (a.q + b.q) + 5.0 / 32.0 * h * (a.v - b.v) + h * h / 64.0 * (a.a + b.a),
        15.0 / 8.0 / h * (b.q - a.q) - 7.0 / 16.0 * (a.v + b.v) + h / 32.0 * (b.a - a.a), a.a};
    const auto at_a = rod.energy(a), at_b = rod.energy(b);
    if (a.t == 0.0) start = at_a.total();
    end = at_b.total();
    lost += h / 6.0 * (at_a.loss + 4.0 * rod.energy(middle).loss + at_b.loss);
  });
  EXPECT_GT(lost, 0.0);
  EXPECT_NEAR((start - end) / lost, 1.0, kEnergy);
}

/// Largest rms difference of a quantity from a finer run, relative to the channel's rms.
double difference(const Experiment& e, Quantity quantity, const Record& coarse,
                  const Record& fine) {
  double largest = 0.0;
  for (int c = 0; c < fine.values.cols(); ++c) {
    if (e.channels[c].quantity != quantity) continue;
    const VectorXd signal = fine.values.col(c).array() - fine.rest[c];
    largest = std::max(largest, (coarse.values.col(c) - fine.values.col(c)).norm() / signal.norm());
  }
  return largest;
}

TEST(Dynamics, LargeRingDownIsConverged) {
  const Experiment e = horizontalRingdown(0.4, 0.5);
  Accuracy fine;
  fine.resolution = {12, 10, 20};
  fine.tolerance = 1e-8;
  const Record reference = simulate(e, fine);
  const Record record = simulate(e);
  EXPECT_LT(difference(e, Quantity::kPosition, record, reference), kConverged);
  EXPECT_LT(difference(e, Quantity::kVelocity, record, reference), kVisible);
}

}  // namespace
}  // namespace cosserat_cable::generator
