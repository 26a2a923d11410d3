// The rigs, against closed forms.
#include "cosserat_cable/measurement/experiment_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "rigs.h"
#include "tools/validation.h"

namespace cosserat_cable {
namespace {

using testing::CableSpecimen;
using testing::ChannelAt;
using testing::kPi;
using testing::RingDown;
using testing::SampleEvenly;
using testing::Torsion;

SimulationOptions Fine() {
  SimulationOptions options;
  options.dt = 5e-4;
  options.elements = 40;
  return options;
}

/// Time of the n-th crossing of zero, between samples.
double Crossing(const Experiment& experiment, const Eigen::VectorXd& y, int n) {
  for (Eigen::Index i = 1; i < y.size(); ++i)
    if (y[i - 1] * y[i] < 0 && n-- == 0) {
      const double x = y[i - 1] / (y[i - 1] - y[i]);
      return experiment.record.t[i - 1] + x * (experiment.record.t[i] - experiment.record.t[i - 1]);
    }
  return std::nan("");
}

TEST(ExperimentSimulationTest, ARingDownSwingsAsEulerAndBernoulliSay) {
  const Experiment experiment = RingDown(0.001, 4.0, 4001);
  const Specimen specimen = CableSpecimen();
  const RefinedRecord refined = SimulateRefined(experiment, specimen, Fine());
  ASSERT_TRUE(refined.record.ok) << refined.record.message;
  const Eigen::VectorXd z = refined.record.values.col(0);
  EXPECT_NEAR(z[0], 0.001, 1e-9);
  const CableModel& m = specimen.cable;
  const double w = std::pow(1.87510407 / m.length, 2) * std::sqrt(m.EI1 / m.mass_per_length);
  // Shear and rotary inertia lower it by some 2 (d/L)^2 (1/16 + 3/16) mu^2; crossings also see the
  // second mode's rest.
  constexpr double kSlenderness = 2e-3;
  EXPECT_NEAR(kPi / (Crossing(experiment, z, 9) - Crossing(experiment, z, 8)), w, kSlenderness * w);
  // Amplitudes fall as exp(-delta t), delta = w^2 eta/(2 EI), whatever higher modes there were.
  const double delta = w * w * m.eta_EI1 / (2 * m.EI1);
  const auto half_swing = [&](double from, double to) {
    double largest = 0;
    for (Eigen::Index i = 0; i < z.size(); ++i)
      if (experiment.record.t[i] >= from && experiment.record.t[i] < to)
        largest = std::max(largest, std::abs(z[i]));
    return largest;
  };
  const double period = 2 * kPi / w;
  const double decay =
      std::log(half_swing(2 * period, 3 * period) / half_swing(5 * period, 6 * period)) /
      (3 * period);
  constexpr double kPeaksBetweenSamples = 0.02;
  EXPECT_NEAR(decay, delta, kPeaksBetweenSamples * delta);
}

TEST(ExperimentSimulationTest, ATorsionalPendulumFollowsEquations12And13) {
  const double J = 2e-6, D_E = 3e-6;
  const Experiment experiment = Torsion(J, 0.5, 1.0, 1001);
  Specimen specimen = CableSpecimen();
  specimen.disc_inertia = J;
  specimen.cable.extensions.push_back({"clamp_damping", {{{"b.torsion", D_E}}}});
  const RefinedRecord refined = SimulateRefined(experiment, specimen, Fine());
  ASSERT_TRUE(refined.record.ok) << refined.record.message;
  const Eigen::VectorXd angle = refined.record.values.col(0);
  EXPECT_NEAR(angle[0], 0.5, 1e-9);
  const CableModel& m = specimen.cable;
  const double inertia = J + m.rhoJ() * m.length / 3;
  const double delta = (m.eta_GJ / m.length + D_E) / (2 * inertia);
  const double Omega = std::sqrt(m.GJ / (m.length * inertia) - delta * delta);
  // angle = 0.5 exp(-delta t)(cos Omega t + delta/Omega sin Omega t); rhoJ L/3 is good to
  // (rhoJ L/J)^2.
  constexpr double kCableInertia = 2e-3;
  for (Eigen::Index i = 0; i < angle.size(); i += 50) {
    const double t = experiment.record.t[i];
    const double expected =
        0.5 * std::exp(-delta * t) * (std::cos(Omega * t) + delta / Omega * std::sin(Omega * t));
    EXPECT_NEAR(angle[i], expected, kCableInertia * 0.5) << "t = " << t;
  }
  // From the third to the ninth half swing, at whose ends the angle is extreme.
  const auto extreme = [&](int n) {
    const double period = kPi / Omega;
    const auto first = static_cast<Eigen::Index>((n - 0.5) * period / 1e-3);
    return angle.segment(first, static_cast<Eigen::Index>(period / 1e-3)).cwiseAbs().maxCoeff();
  };
  constexpr double kBetweenSamples = 5e-3;  // 1 ms is 0.06 rad of a swing: 4e-4 of an extreme
  Validate({"Causes", "clamp_damping: decay of a torsional pendulum by its fixation [1/s]",
            "source paper, eq. (13)", delta, std::log(extreme(3) / extreme(9)) * Omega / (6 * kPi),
            kBetweenSamples * delta, Fine().elements, Fine().dt});
}

// Coulomb: 2 slip_moment/(GJ/L) each half swing, however far it turns: a swing of 4 rad is more
// than half a turn to each side.
TEST(ExperimentSimulationTest, ADiscWhoseBearingRubsLosesTheSameInEverySwing) {
  constexpr double kInertia = 2e-5, kSlipMoment = 1.6e-4, kStuck = 8;
  Specimen specimen = CableSpecimen();
  specimen.disc_inertia = kInertia;
  specimen.cable.eta_GJ = 0;
  specimen.cable.extensions.push_back({"clamp_friction",
                                       {{{"b_torsion.stuck", kStuck},
                                         {"b_torsion.slip_moment", kSlipMoment},
                                         {"b_torsion.spring", 0.0}}}});
  const CableModel& m = specimen.cable;
  const double k = m.GJ / m.length, drop = 2 * kSlipMoment / k;
  const double period = 2 * kPi * std::sqrt((kInertia + m.rhoJ() * m.length / 3) / k);
  for (const double angle : {0.5, 4.0}) {
    const Experiment experiment = Torsion(kInertia, angle, 4.2 * period, 2001);
    const RefinedRecord refined = SimulateRefined(experiment, specimen, Fine());
    ASSERT_TRUE(refined.record.ok) << refined.record.message;
    const Eigen::VectorXd turned = refined.record.values.col(0);
    // The bearing's spring gives way by a thousandth of what the wire does.
    constexpr double kStuckGivesWay = 0.02;
    for (int half = 1; half <= 8; ++half) {
      const auto middle = static_cast<Eigen::Index>(half * 0.5 / 4.2 * 2000);
      const double peak = turned.segment(middle - 60, 120).cwiseAbs().maxCoeff();
      EXPECT_NEAR(peak, angle - half * drop, kStuckGivesWay * drop * half) << angle << " " << half;
    }
  }
}

TEST(ExperimentSimulationTest, VelocityAndAccelerationAreDerivativesOfThePosition) {
  Experiment experiment = RingDown(0.01, 0.3, 301);
  const double L = CableSpecimen().cable.length;
  experiment.channels.push_back(ChannelAt(L, Quantity::kVelocity, 2));
  experiment.channels.push_back(ChannelAt(L, Quantity::kAcceleration, 2));
  const SimulatedRecord record = SimulateExperiment(experiment, {CableSpecimen()}, Fine()).front();
  ASSERT_TRUE(record.ok) << record.message;
  const double h = experiment.record.t[1] - experiment.record.t[0];
  const double velocity_scale = record.values.col(1).cwiseAbs().maxCoeff();
  // Central differences over 1 ms of what has modes up to some 100 Hz.
  constexpr double kDifference = 0.02;
  for (int i = 100; i < 300; ++i) {
    EXPECT_NEAR(record.values(i, 1), (record.values(i + 1, 0) - record.values(i - 1, 0)) / (2 * h),
                kDifference * velocity_scale);
  }
  const double acceleration_scale = record.values.col(2).tail(200).cwiseAbs().maxCoeff();
  for (int i = 100; i < 300; ++i) {
    EXPECT_NEAR(record.values(i, 2), (record.values(i + 1, 1) - record.values(i - 1, 1)) / (2 * h),
                kDifference * acceleration_scale);
  }
}

TEST(ExperimentSimulationTest, ASpecimenDoesNotDependOnItsNeighbours) {
  const Experiment experiment = RingDown(0.02, 0.1, 51);
  std::vector<Specimen> specimens(6, CableSpecimen());
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    specimens[k].cable.EI1 *= 1 + 0.1 * static_cast<double>(k);
    specimens[k].cable.EI2 = specimens[k].cable.EI1;
  }
  const auto all = SimulateExperiment(experiment, specimens, Fine());
  const auto other =
      SimulateExperiment(experiment, {specimens[2], specimens[5], specimens[0]}, Fine());
  ASSERT_TRUE(all[2].ok && other[0].ok);
  EXPECT_EQ(all[2].values, other[0].values);
  EXPECT_EQ(all[5].values, other[1].values);
  EXPECT_EQ(all[0].values, other[2].values);
}

TEST(ExperimentSimulationTest, QuasiStaticStepsGiveTheForceOfACantilever) {
  Experiment experiment;
  experiment.gravity_W.setZero();
  experiment.a.pose.q = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitY());
  const Specimen specimen = CableSpecimen();
  const double L = specimen.cable.length;
  ClampMotion motion;
  motion.quasi_static = true;
  for (int step = 0; step < 5; ++step) {
    motion.t.push_back(step);
    motion.poses.push_back({Eigen::Vector3d(L, 0, 0.001 * step), experiment.a.pose.q});
    experiment.record.t.push_back(step);
  }
  experiment.b.motion = motion;
  experiment.b.translation_free = {false, false, true};
  experiment.b.rotation_free = {true, true, true};
  experiment.record.quasi_static = true;
  Channel force = ChannelAt(0, Quantity::kForce, 2);
  force.clamp = ClampSide::kB;
  experiment.channels = {force};
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Fine()).front();
  ASSERT_TRUE(record.ok) << record.message;
  // F = 3 EI w/L^3, less shear's share 3 EI/(GA L^2), and of second order in w/L.
  constexpr double kShearAndSize = 1e-3;
  const double stiffness = 3 * specimen.cable.EI1 / std::pow(L, 3);
  for (int step = 1; step < 5; ++step)
    EXPECT_NEAR(record.values(step, 0), stiffness * 0.001 * step,
                kShearAndSize * stiffness * 0.001 * step);
}

TEST(ExperimentSimulationTest, AClampThatRubsLeavesALoopInQuasiStaticSteps) {
  // A tip that is moved aside by w and back: sliding forth and back, the force F on it obeys
  // F (L + s L^2/(3 EI)) = s w/L +- slip_moment.
  constexpr double kSlip = 2e-4, kSpring = 0.02, kStuck = 0.5;
  constexpr double kRelative = 5e-3;  // shear, and of second order in w/L
  Experiment experiment;
  experiment.gravity_W.setZero();
  experiment.a.pose.q = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitY());
  Specimen specimen = CableSpecimen();
  specimen.cable.extensions = {
      {"clamp_friction", {{{"a.stuck", kStuck}, {"a.slip_moment", kSlip}, {"a.spring", kSpring}}}}};
  const double L = specimen.cable.length;
  ClampMotion motion;
  motion.quasi_static = true;
  constexpr int kTurn = 6;
  const auto way = [](int step) { return 0.002 * (step <= kTurn ? step : 2 * kTurn - step); };
  for (int step = 0; step <= 2 * kTurn; ++step) {
    motion.t.push_back(step);
    motion.poses.push_back({Eigen::Vector3d(L, 0, way(step)), experiment.a.pose.q});
    experiment.record.t.push_back(step);
  }
  experiment.b.motion = motion;
  experiment.b.translation_free = {false, false, true};
  experiment.b.rotation_free = {true, true, true};
  experiment.record.quasi_static = true;
  Channel force = ChannelAt(0, Quantity::kForce, 2);
  force.clamp = ClampSide::kB;
  experiment.channels = {force};
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Fine()).front();
  ASSERT_TRUE(record.ok) << record.message;
  const double arm = L + kSpring * L * L / (3 * specimen.cable.EI1);
  for (const int step : {4, 5, 6, 8, 9, 10, 11}) {
    const double sign = step <= kTurn ? 1 : -1;
    const double expected = (kSpring * way(step) / L + sign * kSlip) / arm;
    EXPECT_NEAR(record.values(step, 0), expected, kRelative * (kSpring * way(6) / L + kSlip) / arm)
        << step;
  }
}

TEST(ExperimentSimulationTest, TheCablesLoadsActBesideTheRigs) {
  // Swinging under a dead force across, it loses half the rate of external damping more.
  constexpr double kRate = 2.0;
  constexpr double kPeaksBetweenSamples = 0.02;
  const auto decay = [](const Specimen& specimen) {
    Experiment experiment = RingDown(0.001, 4.0, 4001);
    experiment.load.samples = {{0.0, 0.1, Eigen::Vector3d(0, 0.001, 0)}};
    const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Fine()).front();
    EXPECT_TRUE(record.ok) << record.message;
    const CableModel& m = specimen.cable;
    const double w = std::pow(1.87510407 / m.length, 2) * std::sqrt(m.EI1 / m.mass_per_length);
    const int swing = static_cast<int>(std::lround(2 * kPi / w / 0.001));  // in samples
    const auto largest = [&](int swings) {
      return record.values.col(0).segment(swings * swing, swing).cwiseAbs().maxCoeff();
    };
    return std::log(largest(1) / largest(6)) / (5 * swing * 0.001);
  };
  Specimen plain = CableSpecimen(), damped = plain;
  damped.cable.extensions = {{"external_damping", {{{"rate", kRate}}}}};
  EXPECT_NEAR(decay(damped) - decay(plain), 0.5 * kRate, kPeaksBetweenSamples * 0.5 * kRate);
}

/// Clamp b stands where the end of the straight cable along x is, turned about it by `turn` [rad].
Pose TurnedEnd(const Experiment& experiment, double turn) {
  const Eigen::Quaterniond about_axis(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
  return {Eigen::Vector3d(CableSpecimen().cable.length, 0, 0), experiment.a.pose.q * about_axis};
}

TEST(ExperimentSimulationTest, AnglesCountWholeTurns) {
  Experiment experiment;
  experiment.gravity_W.setZero();
  experiment.a.pose.q = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitY());
  experiment.a.rotation_free = {false, false, true};  // follows end b without a moment
  ClampMotion motion;
  motion.quasi_static = experiment.record.quasi_static = true;
  constexpr int kSteps = 20;
  constexpr double kTurn = 0.5;  // [rad] per step: three turns in all
  for (int step = 0; step < kSteps; ++step) {
    motion.t.push_back(step);
    motion.poses.push_back(TurnedEnd(experiment, kTurn * step));
    experiment.record.t.push_back(step);
  }
  experiment.b.motion = motion;
  experiment.channels = {ChannelAt(0, Quantity::kAngle),
                         ChannelAt(CableSpecimen().cable.length, Quantity::kAngle)};
  const SimulatedRecord record = SimulateExperiment(experiment, {CableSpecimen()}, Fine()).front();
  ASSERT_TRUE(record.ok) << record.message;
  constexpr double kSolved = 1e-6;  // [rad], of equilibria
  for (int step = 0; step < kSteps; ++step)
    for (int c = 0; c < 2; ++c) EXPECT_NEAR(record.values(step, c), kTurn * step, kSolved);
}

TEST(ExperimentSimulationTest, AClampThatLetsTheEndTurnHoldsItTwistedUntilTheRelease) {
  Experiment experiment;
  experiment.gravity_W.setZero();
  experiment.a.pose.q = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitY());
  experiment.b.pose = TurnedEnd(experiment, 0);
  experiment.b.rotation_free = {false, false, true};
  experiment.start.kind = StartCondition::Kind::kTwisted;
  experiment.start.twisted = 1.5;
  const double L = CableSpecimen().cable.length;
  experiment.channels = {ChannelAt(L, Quantity::kAngle), ChannelAt(L / 2, Quantity::kAngle)};
  SampleEvenly(0.01, 11, &experiment);
  const SimulatedRecord record = SimulateExperiment(experiment, {CableSpecimen()}, Fine()).front();
  ASSERT_TRUE(record.ok) << record.message;
  constexpr double kSolved = 1e-6;  // [rad]
  EXPECT_NEAR(record.values(0, 0), 1.5, kSolved);
  EXPECT_NEAR(record.values(0, 1), 0.75, kSolved);
  EXPECT_LT(record.values(10, 0), 1.4);
}

// A moment T a3(L) alone acts on every section of a cable that a disc of no weight is turned on by
// theta:
//   i EI w' + T (w - w(L)) = -c sqrt(EI GJ) tau exp(i tau s),  w = x' + i y', tau = theta/L, T = GJ
//   tau
// to the first order in c; its integral is the end's place.
TEST(ExperimentSimulationTest, ADiscIsTurnedAboutItsOwnAxisWhereBendingIsCoupledToTwist) {
  using Complex = std::complex<double>;
  constexpr double kTheta = 1.0, kCoupling = 1e-3;
  Experiment experiment = Torsion(1e-4, kTheta, 0.001, 2);
  experiment.gravity_W.setZero();
  experiment.a.pose.q.setIdentity();
  experiment.b.disc.guided = false;
  Specimen specimen = CableSpecimen();
  const CableModel& m = specimen.cable;
  const double L = m.length;
  experiment.channels = {ChannelAt(L, Quantity::kPosition, 0),
                         ChannelAt(L, Quantity::kPosition, 1)};
  specimen.cable.extensions = {{"bend_twist_coupling", {{{"c1", kCoupling}, {"c2", 0.0}}}}};
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Fine()).front();
  ASSERT_TRUE(record.ok) << record.message;

  const Complex i(0, 1);
  const double tau = kTheta / L, beta = m.GJ * tau / m.EI1;
  const Complex amplitude = kCoupling * std::sqrt(m.GJ / m.EI1) * tau / (tau - beta);
  const Complex turned = std::exp(i * (tau - beta) * L);
  const Complex tip =
      amplitude * ((std::exp(i * tau * L) - 1.0) / (i * tau) -
                   turned * (std::exp(i * beta * L) - 1.0) / (i * beta) - L * (1.0 - turned));
  constexpr double kOfElements = 2e-3;  // the section's turn within an element
  EXPECT_NEAR(record.values(0, 0), tip.real(), kOfElements * std::abs(tip));
  EXPECT_NEAR(record.values(0, 1), tip.imag(), kOfElements * std::abs(tip));
}

TEST(ExperimentSimulationTest, ARigStandsStillBeforeItsMotionBegins) {
  Experiment experiment = RingDown(0.001, 0.1, 101);
  experiment.start = StartCondition();
  ClampMotion motion;
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.05 + 0.01 * i;
    motion.t.push_back(t);
    motion.poses.push_back(
        {Eigen::Vector3d(0, 0, 0.1 * std::pow(t - 0.05, 2)), experiment.a.pose.q});
  }
  experiment.a.motion = motion;
  experiment.channels.push_back(ChannelAt(CableSpecimen().cable.length, Quantity::kVelocity, 2));
  const SimulatedRecord record = SimulateExperiment(experiment, {CableSpecimen()}, Fine()).front();
  ASSERT_TRUE(record.ok) << record.message;
  constexpr double kStill = 1e-12;
  for (int i = 0; i < 50; ++i) {
    EXPECT_NEAR(record.values(i, 0), record.values(0, 0), kStill);
    EXPECT_EQ(record.values(i, 1), 0.0);
  }
  EXPECT_GT(record.values.col(0).tail(20).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(ExperimentSimulationTest, ALargeSwingAtTheStartKeepsTheCablesLength) {
  Experiment experiment = RingDown(0.001, 0.002, 3);
  experiment.start.kind = StartCondition::Kind::kUnknown;
  experiment.channels.clear();
  const double L = CableSpecimen().cable.length;
  constexpr int kPoints = 25;
  for (int i = 0; i <= kPoints; ++i)
    for (int axis : {0, 1, 2})
      experiment.channels.push_back(ChannelAt(L * i / kPoints, Quantity::kPosition, axis));
  Specimen specimen = CableSpecimen();
  const SwingShape shape =
      FindSwingShapes(experiment, specimen, specimen.cable.elements, 1).front();
  constexpr double kAmplitude = 0.1;  // [m] of 0.25: the end turns by half a radian
  for (std::size_t i = 0; i < shape.displacement.size(); ++i) {
    specimen.swing.displacement.push_back(kAmplitude * shape.displacement[i]);
    specimen.swing.rotation.push_back(kAmplitude * shape.rotation[i]);
    specimen.swing.velocity.push_back(Eigen::Vector3d::Zero());
    specimen.swing.angular_velocity.push_back(Eigen::Vector3d::Zero());
  }
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Fine()).front();
  ASSERT_TRUE(record.ok) << record.message;
  const auto point = [&](int i) -> Eigen::Vector3d {
    return record.values.row(0).segment(3 * i, 3).transpose();
  };
  double length = 0;
  for (int i = 0; i < kPoints; ++i) length += (point(i + 1) - point(i)).norm();
  // Chords of 1 cm of a curve of radius 0.2 m and more, and the shear of the shape itself.
  constexpr double kChords = 3e-4;
  EXPECT_NEAR(length, L, kChords * L);
  const double deflection = std::hypot(point(kPoints).y(), point(kPoints).z());
  EXPECT_GT(deflection, 0.8 * kAmplitude);
  EXPECT_LT(deflection, kAmplitude);
}

TEST(ExperimentSimulationTest, ARigidClampAndOneThatGivesWayGoSideBySide) {
  const Experiment experiment = RingDown(0.001, 0.5, 101);
  const Specimen rigid = CableSpecimen();
  Specimen soft = rigid;
  soft.cable.extensions = {{"clamp_compliance", {{{"a.bending", 0.5}}}}};
  const std::vector<Specimen> specimens = {rigid, soft, rigid};
  const std::vector<SimulatedRecord> together = SimulateExperiment(experiment, specimens, Fine());
  constexpr double kRounding = 1e-9;  // [m]: lanes and single rods end Newton's iterations alike
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    const SimulatedRecord alone = SimulateExperiment(experiment, {specimens[k]}, Fine()).front();
    ASSERT_TRUE(together[k].ok && alone.ok) << together[k].message << alone.message;
    EXPECT_LT((together[k].values - alone.values).cwiseAbs().maxCoeff(), kRounding) << k;
  }
  EXPECT_GT((together[1].values - together[0].values).cwiseAbs().maxCoeff(), 1e-4);
}

}  // namespace
}  // namespace cosserat_cable
