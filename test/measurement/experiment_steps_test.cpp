// An experiment goes through the same steps as a vehicle's cable, and the same retry.
#include <gtest/gtest.h>

#include <cmath>

#include "cosserat_cable/cable/cable_rod.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/math/pose_curve.h"
#include "cosserat_cable/rod/initial_shape.h"
#include "measurement/rigs.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;
using testing::CableSpecimen;
using testing::ChannelAt;

// Powers of two: the times of steps and samples are the same, to the last bit, however they are
// added up.
constexpr double kStep = 1.0 / 1024;
constexpr int kParts = 10;  // of the first step, which grow from kStep/2^10 on

/// The cable in a U between clamps 0.15 m apart; clamp b moves as `way` [m] says, along x. Channels
/// are the forces and moments of both clamps.
template <class Way>
Experiment Shaken(const Way& way, int samples) {
  Experiment experiment;
  experiment.a.pose.q = Eigen::Quaterniond(0, 1, 0, 0);
  ClampMotion motion;
  for (int i = 0; i <= samples; ++i) {
    const double t = i * kStep;
    motion.t.push_back(t);
    motion.poses.push_back({Vector3d(way(t), 0.15, 0), Eigen::Quaterniond::Identity()});
    experiment.record.t.push_back(t);
  }
  experiment.b.motion = motion;
  for (const ClampSide side : {ClampSide::kA, ClampSide::kB})
    for (const Quantity quantity : {Quantity::kForce, Quantity::kMoment})
      for (const int axis : {0, 1, 2}) {
        experiment.channels.push_back(ChannelAt(0, quantity, axis));
        experiment.channels.back().clamp = side;
      }
  return experiment;
}

struct HandRun {
  Eigen::MatrixXd values;  ///< as of SimulatedRecord
  int retried = 0;         ///< steps that were taken in parts
  bool ok = true;
};

/// The experiment through CableSimulation, step by step.
HandRun StepByHand(const Experiment& experiment, const CableModel& cable, double dt) {
  const ClampMotion& motion = *experiment.b.motion;
  PoseCurve curve;
  for (std::size_t i = 0; i < motion.t.size(); ++i) curve.Append(motion.t[i], motion.poses[i]);
  curve.Finish();
  Surroundings now;
  now.a.X = experiment.a.pose;
  now.b = curve.Evaluate(0);
  const rod::RodModel model = MakeRodModel(cable, experiment.gravity_W);
  rod::Rod settled(model);
  settled.SetConfiguration(
      rod::BowedShape(now.a.X, now.b.X, cable.length, cable.elements, experiment.gravity_W));
  EXPECT_TRUE(settled.Equilibrate().converged);
  std::vector<Pose> nodes;
  for (int i = 0; i <= cable.elements; ++i) nodes.push_back(settled.pose(i));
  rod::Rod start(model);
  start.SetConfiguration(nodes);
  start.SetClamps(now.a.X, now.b.X);
  CableSimulation simulation(cable, std::move(start), now);

  HandRun run;
  const double end = experiment.record.t.back();
  const int steps = static_cast<int>(std::lround(end / dt));
  run.values.resize(steps + 1, 12);
  const auto sample = [&](int step) {
    const CableReport report = simulation.ReportForces();
    run.values.row(step) << report.force_a.transpose(), report.moment_a.transpose(),
        report.force_b.transpose(), report.moment_b.transpose();
  };
  const auto advance = [&](double t, double h) {
    now.b = curve.Evaluate(t + h);
    const StepOutcome outcome = simulation.Step(h, now);
    run.ok &= outcome.ok;
    run.retried += outcome.substeps > 1;
  };
  sample(0);
  double part = std::ldexp(dt, -kParts);
  advance(0, part);
  for (double t = part; part < dt; t += part, part *= 2) advance(t, part);
  sample(1);
  for (int step = 2; step <= steps; ++step) {
    advance((step - 1) * dt, dt);
    sample(step);
  }
  return run;
}

SimulationOptions Steps(double dt) {
  SimulationOptions options;
  options.dt = dt;
  options.elements = 20;
  return options;
}

CableModel Cable() {
  CableModel cable = CableSpecimen().cable;
  cable.elements = 20;
  return cable;
}

TEST(ExperimentStepsTest, AreThoseOfACableThatIsSteppedByHand) {
  const Experiment experiment =
      Shaken([](double t) { return 0.02 * std::pow(std::sin(40 * t), 3); }, 200);
  Specimen specimen;
  specimen.cable = Cable();
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Steps(kStep)).front();
  ASSERT_TRUE(record.ok) << record.message;
  const HandRun hand = StepByHand(experiment, specimen.cable, kStep);
  ASSERT_TRUE(hand.ok);
  EXPECT_EQ(record.values, hand.values);
}

/// Sampled every 16 ms, in one of which the clamp goes 0.1 m.
Experiment Jolted() {
  Experiment experiment = Shaken([](double t) { return 0.05 * std::tanh((t - 0.1) / 0.004); }, 256);
  std::vector<double> t;
  for (std::size_t i = 0; i < experiment.record.t.size(); i += 16)
    t.push_back(experiment.record.t[i]);
  experiment.record.t = t;
  return experiment;
}

TEST(ExperimentStepsTest, AStepThatDoesNotConvergeIsTakenInParts) {
  constexpr double kLongStep = 16 * kStep;
  const Experiment experiment = Jolted();
  Specimen specimen;
  specimen.cable = Cable();
  const HandRun hand = StepByHand(experiment, specimen.cable, kLongStep);
  ASSERT_TRUE(hand.ok);
  ASSERT_GT(hand.retried, 0);
  const SimulatedRecord record =
      SimulateExperiment(experiment, {specimen}, Steps(kLongStep)).front();
  ASSERT_TRUE(record.ok) << record.message;
  EXPECT_EQ(record.values, hand.values);
}

TEST(ExperimentStepsTest, AStepThatDoesNotConvergeInLanesIsTakenInPartsToo) {
  constexpr double kRounding = 1e-6;  // of the largest value
  constexpr double kLongStep = 16 * kStep;
  const Experiment experiment = Jolted();
  std::vector<Specimen> specimens(3);
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    specimens[k].cable = Cable();
    specimens[k].cable.mass_per_length *= 1 + 0.1 * static_cast<double>(k);
  }
  const auto records = SimulateExperiment(experiment, specimens, Steps(kLongStep));
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    ASSERT_TRUE(records[k].ok) << records[k].message;
    const HandRun hand = StepByHand(experiment, specimens[k].cable, kLongStep);
    EXPECT_GT(hand.retried, 0) << k;
    const double largest = hand.values.cwiseAbs().maxCoeff();
    EXPECT_LT((records[k].values - hand.values).cwiseAbs().maxCoeff(), kRounding * largest) << k;
  }
}

/// A straight cable without weight, held at a; the channels are the forces of clamp a.
Experiment Cantilever() {
  Experiment experiment;
  experiment.gravity_W.setZero();
  experiment.a.pose.q = Eigen::AngleAxisd(testing::kPi / 2, Vector3d::UnitY());
  experiment.b.kind = EndCondition::Kind::kFree;
  for (const int axis : {0, 1, 2}) {
    experiment.channels.push_back(ChannelAt(0, Quantity::kForce, axis));
    experiment.channels.back().clamp = ClampSide::kA;
  }
  experiment.load.file = "forces.csv";
  return experiment;
}

TEST(ExperimentStepsTest, ForcesOfAFileAreThoseOfEachStepsTime) {
  constexpr double kRounding = 1e-9;  // N
  Experiment experiment = Cantilever();
  // On the clamp's own node: the clamp takes them at once.
  experiment.load.samples = {{0.0, 0, {0, 0, 0}}, {0.05, 0, {0, 0.5, 1}}, {0.075, 0, {0, 0.5, 0}}};
  testing::SampleEvenly(0.1, 101, &experiment);
  Specimen specimen;
  specimen.cable = Cable();
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Steps(5e-4)).front();
  ASSERT_TRUE(record.ok) << record.message;
  for (int i = 0; i <= 100; ++i) {
    const double t = experiment.record.t[static_cast<std::size_t>(i)];
    // Beside a corner, the polynomial between the steps is off.
    if (std::abs(t - 0.05) < 2e-3 || std::abs(t - 0.075) < 2e-3) continue;
    const double z = t < 0.05 ? t / 0.05 : t < 0.075 ? (0.075 - t) / 0.025 : 0.0;
    EXPECT_NEAR(record.values(i, 1), -0.5 * std::min(1.0, t / 0.05), kRounding) << t;
    EXPECT_NEAR(record.values(i, 2), -z, kRounding) << t;
  }
}

TEST(ExperimentStepsTest, ForcesOfAFileAreThoseOfEachQuasiStaticStep) {
  constexpr double kSolved = 1e-9;  // N, of equilibria
  Experiment experiment = Cantilever();
  const double L = CableSpecimen().cable.length;
  // Two forces at once, one of them ends after step 2.
  experiment.load.samples = {{0, L, {0, 0, 0}},
                             {0, L / 2, {0, 0.001, 0}},
                             {2, L, {0, 0, 0.004}},
                             {2, L / 2, {0, 0.003, 0}},
                             {4, L, {0, 0, 0.002}}};
  experiment.load.quasi_static = experiment.record.quasi_static = true;
  for (int step = 0; step <= 4; ++step) experiment.record.t.push_back(step);
  Specimen specimen;
  specimen.cable = Cable();
  const SimulatedRecord record = SimulateExperiment(experiment, {specimen}, Steps(5e-4)).front();
  ASSERT_TRUE(record.ok) << record.message;
  const double y[] = {0.001, 0.002, 0.003, 0.003, 0}, z[] = {0, 0.002, 0.004, 0.003, 0.002};
  for (int step = 0; step <= 4; ++step) {
    EXPECT_NEAR(record.values(step, 1), -y[step], kSolved) << step;
    EXPECT_NEAR(record.values(step, 2), -z[step], kSolved) << step;
  }
}

}  // namespace
}  // namespace cosserat_cable
