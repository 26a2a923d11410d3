// Slips of calibration are named, and good records have none. That they are found in data of
// another simulation is for test/tools/identify_test.
#include "../../src/identification/channel_slips.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <random>
#include <utility>

#include "../measurement/rigs.h"

namespace cosserat_cable {
namespace {

using testing::CableSpecimen;

constexpr double kDeflection = 0.04, kNoise = 1e-4;  // [m]
constexpr double kInterval = 0.01;                   // [s]
constexpr int kCount = 151;

MeasurementSet SetWith(const Experiment& experiment, const char* uncertain) {
  MeasurementSet set;
  const std::string text = std::string("length: 0.25\n") +
                           "diameter: 0.006\nmass_per_length: 0.05\nEI: 0.003\nGJ: 0.0019\n" +
                           "eta_EI: 1.0e-5\neta_GJ: 4.0e-6\nuncertain: " + uncertain + "\n";
  Problems problems;
  MapReader map(YamlValue::Root("set", YAML::Load(text), &problems));
  set.cable = ReadCableKeys(&map);
  set.cable_mark = map.mark();
  EXPECT_TRUE(problems.empty()) << problems.ToString();
  set.experiments = {experiment};
  return set;
}

void Record(const Specimen& specimen, double noise, Experiment* experiment) {
  const SimulatedRecord record = SimulateRefined(*experiment, specimen, {}).record;
  ASSERT_TRUE(record.ok) << record.message;
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, noise);
  experiment->record.values = record.values.unaryExpr([&](double y) { return y + normal(random); });
}

/// A cantilever along x that falls back from a pull along z, seen along z and x.
Experiment Swinging() {
  Experiment experiment = testing::RingDown(kDeflection, kInterval * (kCount - 1), kCount);
  experiment.channels.push_back(
      testing::ChannelAt(CableSpecimen().cable.length, Quantity::kPosition, 0));
  experiment.channels[0].column = "tip_z";
  experiment.channels[1].column = "tip_x";
  Record(CableSpecimen(), kNoise, &experiment);
  return experiment;
}

Experiment OnlyZ(Experiment experiment) {
  experiment.channels.resize(1);
  experiment.record.values = experiment.record.values.leftCols(1).eval();
  return experiment;
}

Estimation Fitted(const MeasurementSet& set) {
  EstimationOptions options;
  options.profiles = options.scatter = false;
  Problems problems;
  const Estimation estimation = Estimate(set, options, &problems);
  EXPECT_TRUE(problems.empty()) << problems.ToString();
  EXPECT_TRUE(estimation.ok) << estimation.message;
  return estimation;
}

Estimation Fitted(const Experiment& experiment, const char* uncertain = "[EI, eta_EI]") {
  return Fitted(SetWith(experiment, uncertain));
}

/// The only slip, or nothing of a kind.
ChannelSlip OnlySlip(const Estimation& estimation) {
  std::string all;
  for (const ChannelSlip& slip : estimation.slips) all += slip.text + "\n";
  EXPECT_EQ(estimation.slips.size(), 1u) << all;
  if (estimation.slips.size() != 1) return {};
  // With the slip mended, noise is left: within a factor for what steps and search leave.
  EXPECT_LT(estimation.slips[0].after, 2.0);
  EXPECT_GT(estimation.slips[0].before, 5.0);
  return estimation.slips[0];
}

TEST(ChannelSlipsTest, AGoodRecordHasNone) {
  const Estimation estimation = Fitted(Swinging());
  EXPECT_TRUE(estimation.slips.empty()) << estimation.slips[0].text;
  for (const ChannelFit& channel : estimation.experiments[0].channels) {
    EXPECT_FALSE(channel.misfit) << channel.column;
    EXPECT_NEAR(channel.times_noise, 1, 0.4) << channel.column;  // 151 samples: 24 %
  }
}

TEST(ChannelSlipsTest, AZeroBesideTheClampIsAConstant) {
  Experiment experiment = Swinging();
  experiment.record.values.col(0).array() += 0.004;
  const Estimation estimation = Fitted(experiment);
  const ChannelSlip slip = OnlySlip(estimation);
  EXPECT_EQ(slip.column, "tip_z");
  EXPECT_EQ(slip.kind, "offset");
  EXPECT_NEAR(slip.constant, 0.004, 1e-4);  // the noise's mean, and what EI takes of it
  EXPECT_NE(slip.text.find("a constant of 4.0 mm: `offset: unknown`?"), std::string::npos)
      << slip.text;
}

TEST(ChannelSlipsTest, AMirroredAxisIsASign) {
  Experiment experiment = OnlyZ(Swinging());
  experiment.record.values *= -1;
  const Estimation estimation = Fitted(experiment);
  const ChannelSlip slip = OnlySlip(estimation);
  EXPECT_EQ(slip.kind, "sign");
  EXPECT_EQ(slip.text, "tip_z fits with its sign turned");
  for (const ParameterEstimate& one : estimation.parameters) {
    if (one.determined) continue;
    EXPECT_NE(one.reason.find("sign turned"), std::string::npos) << one.reason;
  }
  for (const std::string& warning : estimation.warnings)
    EXPECT_EQ(warning.find("nothing but noise"), std::string::npos) << warning;
}

TEST(ChannelSlipsTest, AScaleIsAFactor) {
  Experiment experiment = Swinging();
  experiment.record.values.col(0) *= 1.8;
  const ChannelSlip slip = OnlySlip(Fitted(experiment));
  EXPECT_EQ(slip.column, "tip_z");
  EXPECT_EQ(slip.kind, "gain");
  EXPECT_NEAR(slip.factor, 1.8, 0.01);
}

TEST(ChannelSlipsTest, MetresThatWereTakenForMillimetres) {
  Experiment experiment = OnlyZ(Swinging());
  experiment.record.values *= 1e3;
  const ChannelSlip slip = OnlySlip(Fitted(experiment));
  EXPECT_EQ(slip.kind, "unit");
  EXPECT_EQ(slip.text, "tip_z fits as millimetres (factor 0.001)");
}

TEST(ChannelSlipsTest, AxesThatWereExchanged) {
  Experiment experiment = Swinging();
  experiment.record.values.col(0).swap(experiment.record.values.col(1));
  const Estimation estimation = Fitted(experiment);
  ASSERT_EQ(estimation.slips.size(), 2u);
  EXPECT_EQ(estimation.slips[0].kind, "swapped");
  EXPECT_EQ(estimation.slips[0].shows, "tip_x");
  EXPECT_EQ(estimation.slips[1].shows, "tip_z");
}

class CameraThatRan : public ::testing::TestWithParam<int> {};

TEST_P(CameraThatRan, BeforeTheReleaseIsTold) {
  Experiment experiment = OnlyZ(Swinging());
  const int still = GetParam();
  std::mt19937 random(9);
  std::normal_distribution<double> normal(0, kNoise);
  Eigen::MatrixXd values(kCount + still, 1);
  for (int i = 0; i < still; ++i) values(i, 0) = kDeflection + normal(random);
  values.bottomRows(kCount) = experiment.record.values;
  experiment.record.values = values;
  for (int i = 0; i < still; ++i) experiment.record.t.push_back(kInterval * (kCount + i));
  const ChannelSlip slip = OnlySlip(Fitted(experiment));
  EXPECT_EQ(slip.kind, "start");
  EXPECT_NEAR(slip.delay, still * kInterval, 0.2 * kInterval);
  char text[60];
  std::snprintf(text, sizeof text, "still until %.2f s: let go there?", still * kInterval);
  EXPECT_EQ(slip.text, text);
}

// The second is still for more than half of its record.
INSTANTIATE_TEST_SUITE_P(Early, CameraThatRan, ::testing::Values(40, kCount + kCount / 5));

TEST(ChannelSlipsTest, DegreesForRadians) {
  const double J = 2e-6;
  Experiment experiment = testing::Torsion(J, 0.5, 1.0, 201);
  Specimen specimen = CableSpecimen();
  specimen.disc_inertia = J;
  Record(specimen, 0.002, &experiment);
  experiment.record.values *= 180 / testing::kPi;
  const ChannelSlip slip = OnlySlip(Fitted(experiment, "[GJ, eta_GJ]"));
  EXPECT_EQ(slip.kind, "unit");
  EXPECT_NE(slip.text.find("fits as degrees"), std::string::npos) << slip.text;
}

/// The cable hangs, its end pulled aside in steps by a force along x, and seen along x.
Experiment Loaded(const char* name, double farthest, double g = 9.81) {
  Experiment experiment;
  experiment.name = name;
  experiment.gravity_W = {0, 0, -g};
  experiment.a.pose.q = Eigen::Quaterniond(0, 1, 0, 0);
  experiment.b.kind = EndCondition::Kind::kFree;
  const double L = CableSpecimen().cable.length;
  experiment.channels = {testing::ChannelAt(L, Quantity::kPosition, 0),
                         testing::ChannelAt(0.6 * L, Quantity::kPosition, 0)};
  experiment.channels[0].column = "tip_x";
  experiment.channels[1].column = "inner_x";
  for (Channel& channel : experiment.channels) channel.sigma = kNoise;
  experiment.record.quasi_static = experiment.load.quasi_static = true;
  experiment.load.file = "load.csv";
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    experiment.record.t.push_back(i);
    experiment.load.samples.push_back(
        {static_cast<double>(i), L, {farthest * i / (kSteps - 1), 0, 0}});
  }
  Record(CableSpecimen(), kNoise, &experiment);
  return experiment;
}

void ScaleLoad(double factor, Experiment* experiment) {
  for (ExperimentLoad::Sample& sample : experiment->load.samples) sample.force_W *= factor;
}

std::string AllSlips(const Estimation& estimation) {
  std::string all;
  for (const ChannelSlip& slip : estimation.slips) all += slip.experiment + " " + slip.text + "\n";
  return all;
}

struct LoadUnit {
  double of_newton;
  const char* name;
};

class LoadOfOneRecord : public ::testing::TestWithParam<LoadUnit> {};

TEST_P(LoadOfOneRecord, AccusesThatRecordAlone) {
  for (const std::size_t slips : {0, 1}) {
    MeasurementSet set = SetWith(Loaded("small", 0.15), "[EI]");
    set.experiments.push_back(Loaded("large", 0.25));
    ScaleLoad(GetParam().of_newton, &set.experiments[slips]);
    const Estimation estimation = Fitted(set);
    ASSERT_EQ(estimation.slips.size(), 1u) << AllSlips(estimation);
    const ChannelSlip& slip = estimation.slips[0];
    EXPECT_EQ(slip.experiment, set.experiments[slips].name);
    EXPECT_EQ(slip.text, std::string("fits with its load in ") + GetParam().name);
    // A number beyond which the mended load brings [EI] is marked.
    const ParameterEstimate& EI = estimation.parameters[0];
    const double truth = CableSpecimen().cable.EI1;
    if (!EI.determined || (EI.low < truth && EI.high > truth)) continue;
    EXPECT_NE(EI.doubt.find("with that mended it is 0.0027"), std::string::npos) << EI.doubt;
  }
}

// A newton in each.
INSTANTIATE_TEST_SUITE_P(Units, LoadOfOneRecord,
                         ::testing::Values(LoadUnit{0.2248089, "pounds"},
                                           LoadUnit{0.1019716, "kilograms"},
                                           LoadUnit{101.9716, "grams"}));

TEST(ChannelSlipsTest, AHalvedLoadIsAFactorAndNoUnit) {
  Experiment experiment = Loaded("pull", 0.25);
  ScaleLoad(0.5, &experiment);
  const Estimation estimation = Fitted(experiment, "[EI]");
  const ChannelSlip slip = OnlySlip(estimation);
  EXPECT_EQ(slip.kind, "load");
  // Only weight and large bending tell the force from the stiffness: a tenth is 2.5 of its
  // standard deviations.
  EXPECT_NEAR(slip.factor, 2, 0.2);
  // Half of the force bends a cable of half of the stiffness: its number is not the cable's.
  const ParameterEstimate& EI = estimation.parameters[0];
  EXPECT_TRUE(!EI.determined || !EI.doubt.empty());
}

TEST(ChannelSlipsTest, RecordsThatOnlyContradictEachOtherAreBothTold) {
  // Without weight and hardly bent, force and stiffness are told from each other by no record.
  MeasurementSet set = SetWith(Loaded("first", 0.01, 0), "[EI]");
  set.experiments.push_back(Loaded("second", 0.012, 0));
  ScaleLoad(0.2248089, &set.experiments[1]);
  const Estimation estimation = Fitted(set);
  ASSERT_EQ(estimation.slips.size(), 2u) << AllSlips(estimation);
  for (const ChannelSlip& slip : estimation.slips)
    EXPECT_NE(slip.text.find("one of the two records slips"), std::string::npos) << slip.text;
  EXPECT_NE(AllSlips(estimation).find("second fits with its load in pounds"), std::string::npos)
      << AllSlips(estimation);
  const ParameterEstimate& EI = estimation.parameters[0];
  EXPECT_TRUE(!EI.determined || !EI.doubt.empty());
}

TEST(ChannelSlipsTest, ARateOfSamplingThatIsAnotherOne) {
  Experiment experiment = Swinging();
  // Its weight tells the stiffness from the time.
  experiment.gravity_W = {0, 0, -9.81};
  experiment.start = {};
  experiment.start.kind = StartCondition::Kind::kHeld;
  const double L = CableSpecimen().cable.length;
  experiment.start.held = {L, {0.95 * L, 0, 0.03}};
  Record(CableSpecimen(), kNoise, &experiment);
  for (double& t : experiment.record.t) t *= 2;
  const ChannelSlip slip = OnlySlip(Fitted(experiment));
  EXPECT_EQ(slip.kind, "clock");
  EXPECT_NEAR(slip.factor, 0.5, 0.02);
}

/// A cantilever along x on a clamp that moves and turns, its end and middle seen along x and z.
Experiment Shaken() {
  Experiment experiment = testing::RingDown(kDeflection, kInterval * (kCount - 1), kCount);
  experiment.name = "shaken";
  experiment.gravity_W = {0, 0, -9.81};
  experiment.start = {};
  const Eigen::Quaterniond q = experiment.a.pose.q;
  ClampMotion motion;
  motion.file = "clamp_a.csv";
  for (int i = 0; i <= 2 * kCount; ++i) {
    const double t = 0.5 * kInterval * i, grows = 1 - std::exp(-20 * t * t);
    motion.t.push_back(t);
    motion.poses.emplace_back();
    Pose& pose = motion.poses.back();
    pose.p = grows * Eigen::Vector3d(0.02 * std::sin(9 * t), 0.015 * std::sin(8 * t),
                                     0.01 * std::sin(12 * t));
    pose.q = Eigen::AngleAxisd(0.1 * grows * std::sin(7 * t), Eigen::Vector3d::UnitY()) * q;
  }
  experiment.a.motion = motion;
  const double L = CableSpecimen().cable.length;
  experiment.channels.clear();
  for (const auto& [axis, name] :
       {std::pair<int, const char*>{0, "tip_x"}, {1, "tip_y"}, {2, "tip_z"}}) {
    experiment.channels.push_back(testing::ChannelAt(L, Quantity::kPosition, axis));
    experiment.channels.back().column = name;
  }
  Record(CableSpecimen(), kNoise, &experiment);
  return experiment;
}

TEST(ChannelSlipsTest, AShakenCableHasNone) {
  const Estimation estimation = Fitted(Shaken());
  EXPECT_TRUE(estimation.slips.empty()) << AllSlips(estimation);
}

struct MotionSlip {
  std::function<void(Pose*)> of_file;
  const char* words;
};

class WrongMotion : public ::testing::TestWithParam<MotionSlip> {};

TEST_P(WrongMotion, IsNamed) {
  Experiment experiment = Shaken();
  for (Pose& pose : experiment.a.motion->poses) GetParam().of_file(&pose);
  const Estimation estimation = Fitted(experiment);
  const ChannelSlip slip = OnlySlip(estimation);
  EXPECT_EQ(slip.kind, "motion");
  EXPECT_NE(slip.text.find(GetParam().words), std::string::npos) << slip.text;
}

INSTANTIATE_TEST_SUITE_P(
    Slips, WrongMotion,
    ::testing::Values(MotionSlip{[](Pose* pose) { pose->p.z() *= -1; }, "clamp a along z turned"},
                      MotionSlip{[](Pose* pose) { std::swap(pose->p.x(), pose->p.y()); },
                                 "clamp a along x and y exchanged"},
                      MotionSlip{[](Pose* pose) { pose->p *= 1e-3; }, "taken for millimetres"},
                      MotionSlip{[](Pose* pose) { pose->p.z() /= 1.1; },
                                 "with 1.1 times the motion"}));

TEST(ChannelSlipsTest, GravityThatPointsElsewhere) {
  Experiment experiment = Shaken();
  experiment.gravity_W *= -1;
  const ChannelSlip slip = OnlySlip(Fitted(experiment));
  EXPECT_EQ(slip.kind, "gravity");
  EXPECT_NE(slip.text.find("with gravity along -z"), std::string::npos) << slip.text;
}

TEST(ChannelSlipsTest, OneChannelThatIsLate) {
  Experiment experiment = Shaken();
  constexpr int kLate = 2;  // samples
  auto column = experiment.record.values.col(2);
  const Eigen::VectorXd before = column;
  column.tail(kCount - kLate) = before.head(kCount - kLate);
  column.head(kLate).setConstant(before[0]);
  const ChannelSlip slip = OnlySlip(Fitted(experiment));
  EXPECT_EQ(slip.kind, "delay");
  EXPECT_EQ(slip.column, "tip_z");
  EXPECT_NEAR(slip.delay, kLate * kInterval, 0.1 * kInterval);
}

TEST(ChannelSlipsTest, TimesInMillisecondsAreRefused) {
  Experiment experiment = Swinging();
  Problems problems;
  CheckClocks(SetWith(experiment, "[EI]"), &problems);
  EXPECT_TRUE(problems.empty()) << problems.ToString();
  for (double& t : experiment.record.t) t *= 1e3;
  CheckClocks(SetWith(experiment, "[EI]"), &problems);
  EXPECT_NE(problems.ToString().find("in ms"), std::string::npos) << problems.ToString();
}

}  // namespace
}  // namespace cosserat_cable
