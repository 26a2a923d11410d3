// A fit problem on records whose truth is known: warm starts, extensions, held-out records.
#include "cosserat_cable/fit/fit_problem.h"

#include <gtest/gtest.h>

#include <random>

#include "../measurement/rigs.h"

namespace cosserat_cable {
namespace {

using testing::CableSpecimen;

constexpr double kNoise = 2e-5;    // [m]
constexpr double kBeyondLuck = 4;  // standard deviations
constexpr const char* kCd = "extensions.air_drag.Cd";

CableKeys Keys(const std::string& uncertain, const std::string& extensions = "") {
  const std::string text =
      "length: 0.25\ndiameter: 0.006\nmass_per_length: 0.05\nEI: 0.0024\n"
      "GJ: 0.002\neta_EI: 1.0e-5\neta_GJ: 4.0e-6\nuncertain: " +
      uncertain + "\n" + extensions;
  Problems problems;
  MapReader map(YamlValue::Root("set", YAML::Load(text), &problems));
  CableKeys keys = ReadCableKeys(&map);
  EXPECT_TRUE(problems.empty()) << problems.ToString();
  return keys;
}

/// Two ring-downs of the rigs' cable, of 20 and 60 mm, in air with this drag.
MeasurementSet RingDowns(double Cd) {
  MeasurementSet set;
  set.cable = Keys("[EI, eta_EI]");
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0, kNoise);
  for (const double deflection : {0.02, 0.06}) {
    Experiment experiment = testing::RingDown(deflection, 2.0, 401);
    experiment.name = deflection > 0.04 ? "large" : "small";
    experiment.channels[0].sigma = kNoise;
    Specimen specimen = CableSpecimen();
    if (Cd > 0) {
      CableExtension drag;
      drag.name = "air_drag";
      drag.parts = {{{"Cd", Cd}}};
      specimen.cable.extensions.push_back(drag);
    }
    const SimulatedRecord record = SimulateRefined(experiment, specimen, {}).record;
    EXPECT_TRUE(record.ok) << record.message;
    experiment.record.values =
        record.values.unaryExpr([&](double y) { return y + normal(random); });
    set.experiments.push_back(experiment);
  }
  return set;
}

TEST(FitProblemTest, FindsThePlainCableAndLeavesNoise) {
  const MeasurementSet set = RingDowns(0);
  Problems problems;
  FitProblem problem(set, {}, &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  const FitPoint found = problem.FitFromAfar();
  ASSERT_TRUE(found.ok) << found.message;
  EXPECT_NEAR(found.ValueOf("EI"), CableSpecimen().cable.EI1, 1e-3 * CableSpecimen().cable.EI1);
  EXPECT_NEAR(found.cost, found.samples, kBeyondLuck * std::sqrt(2 * found.samples));
  EXPECT_TRUE(std::isnan(found.ValueOf("sunshine")));
}

TEST(FitProblemTest, AnExtensionGrowsFromNothingAndPredictsTheRecordLeftOut) {
  constexpr double kDrag = 8;
  const MeasurementSet set = RingDowns(kDrag);
  Problems problems;
  FitProblem plain(set, {}, &problems);
  const FitPoint without = plain.FitFromAfar();
  ASSERT_TRUE(without.ok) << without.message;
  EXPECT_GT(without.cost, 4 * without.samples);

  MeasurementSet extended_set = set;
  extended_set.cable =
      Keys("[EI, eta_EI, extensions.air_drag.Cd]", "extensions: {air_drag: {Cd: 0.01}}");
  FitProblem extended(extended_set, {}, &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  extended.ShareSteps(plain);
  FitPoint with = extended.FitFrom(without);
  ASSERT_TRUE(with.ok) << with.message;
  // The plain model's steps were as fine as its misfit asked.
  extended.Refine(with);
  with = extended.FitFrom(with);
  ASSERT_TRUE(with.ok) << with.message;
  EXPECT_NEAR(with.ValueOf(kCd), kDrag, 0.02 * kDrag);
  EXPECT_NEAR(with.cost, with.samples, kBeyondLuck * std::sqrt(2 * with.samples));

  FitProblemOptions hold_out;
  hold_out.held_out = {1};
  FitProblem first_only(extended_set, hold_out, &problems);
  first_only.ShareSteps(extended);
  const FitPoint of_first = first_only.FitFrom(with);
  ASSERT_TRUE(of_first.ok) << of_first.message;
  const Eigen::MatrixXd predicted = first_only.Predict(of_first, 1);
  ASSERT_EQ(predicted.rows(), 401);
  // The small swing tells the drag less well than both do, and better than nothing.
  FitProblem plain_of_first(set, hold_out, &problems);
  plain_of_first.ShareSteps(plain);
  const FitPoint plain_found = plain_of_first.FitFrom(without);
  ASSERT_TRUE(plain_found.ok) << plain_found.message;
  const Eigen::MatrixXd plain_predicted = plain_of_first.Predict(plain_found, 1);
  EXPECT_LT(predicted.squaredNorm(), 0.1 * plain_predicted.squaredNorm());
  // What counts for nothing is not in the cost.
  EXPECT_NEAR(of_first.samples, 401, 0);
}

TEST(FitProblemTest, APlaceOnTheCableIsNotSoughtBeyondItsEnd) {
  MeasurementSet set = RingDowns(0);
  set.cable = Keys("[extensions.added_mass.s]", "extensions: {added_mass: {s: 0.2, mass: 1.0e-3}}");
  Problems problems;
  const FitProblem problem(set, {}, &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  EXPECT_EQ(problem.unknowns().all().at(0).upper, 0.25);
}

TEST(FitProblemTest, HeldUnknownsStay) {
  const MeasurementSet set = RingDowns(0);
  FitProblemOptions options;
  options.held = {"eta_EI"};
  Problems problems;
  FitProblem problem(set, options, &problems);
  const FitPoint start = problem.At(problem.unknowns().StartValues());
  ASSERT_TRUE(start.ok) << start.message;
  const FitPoint found = problem.FitFrom(start);
  ASSERT_TRUE(found.ok) << found.message;
  EXPECT_EQ(found.ValueOf("eta_EI"), start.ValueOf("eta_EI"));
  EXPECT_LT(found.cost, start.cost);
}

// A cable that bends alike in all directions has pairs of modes, of which a slightly different one
// has others: amplitudes mean the same only in the same shapes.
TEST(FitProblemTest, AnUnknownStartMeansTheSameWithAnExtension) {
  MeasurementSet set = RingDowns(0);
  set.experiments.resize(1);
  Experiment& experiment = set.experiments[0];
  experiment.start = StartCondition();
  experiment.start.kind = StartCondition::Kind::kUnknown;
  Channel across = experiment.channels[0];
  across.column = "across";
  across.axis = 1;
  experiment.channels.push_back(across);
  experiment.record.values.conservativeResize(Eigen::NoChange, 2);
  experiment.record.values.col(1) = 0.5 * experiment.record.values.col(0);
  Problems problems;
  FitProblem plain(set, {}, &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  Eigen::VectorXd values = plain.unknowns().StartValues();
  int swings = 0;
  for (int i = 0; i < values.size(); ++i) {
    const Unknown& u = plain.unknowns().all()[static_cast<std::size_t>(i)];
    if (u.kind == Unknown::Kind::kSwing) values[i] = ++swings % 2 ? u.prior_sd : 0.3 * u.prior_sd;
  }
  ASSERT_GE(swings, 2);
  const FitPoint found = plain.At(values);
  ASSERT_TRUE(found.ok) << found.message;
  MeasurementSet extended_set = set;
  extended_set.cable = Keys("[EI, eta_EI, extensions.anisotropy.difference]",
                            "extensions: {anisotropy: {difference: 1.0e-6, roll: 0.3}}");
  FitProblem extended(extended_set, {}, &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  extended.ShareSteps(plain);
  const FitPoint there = extended.At(extended.StartFrom(found, {}));
  ASSERT_TRUE(there.ok) << there.message;
  // What so faint an anisotropy does, beside the swing.
  constexpr double kSame = 1e-4;
  EXPECT_LT((there.simulated[0] - found.simulated[0]).norm(), kSame * found.simulated[0].norm());
}

// The variables in which a fit moves: one at the scale, there and back, with the slope between.
TEST(FitVariablesTest, AreOneAtTheScaleAndHaveTheirSlope) {
  constexpr double kStep = 1e-6, kTolerance = 1e-6;
  for (const auto scaling :
       {Unknown::Scaling::kLinear, Unknown::Scaling::kReciprocal, Unknown::Scaling::kLogarithmic}) {
    Unknown u;
    u.scaling = scaling;
    u.scale = 3;
    EXPECT_DOUBLE_EQ(VariableOf(u, 3), 1);
    for (const double value : {0.2, 3.0, 40.0}) {
      const double x = VariableOf(u, value);
      EXPECT_NEAR(ValueOf(u, x), value, 1e-12 * value);
      const double slope = (ValueOf(u, x + kStep) - ValueOf(u, x - kStep)) / (2 * kStep * u.scale);
      EXPECT_NEAR(VariableSlope(u, x) / slope, 1, kTolerance);
    }
  }
}

/// The small ring-down without its beginning, as if nobody had seen it.
MeasurementSet RunningSwing() {
  constexpr Eigen::Index kMissed = 120;
  MeasurementSet set = RingDowns(0);
  set.experiments.resize(1);
  Experiment& experiment = set.experiments[0];
  experiment.start = StartCondition();
  experiment.start.kind = StartCondition::Kind::kUnknown;
  Record& record = experiment.record;
  record.t.erase(record.t.begin(), record.t.begin() + kMissed);
  record.values = Eigen::MatrixXd(record.values.bottomRows(record.values.rows() - kMissed));
  return set;
}

TEST(FitProblemTest, OldDerivativesOfStartsLeadToTheSameMinimumInFewerSimulations) {
  const MeasurementSet set = RunningSwing();
  Problems problems;
  FitProblem problem(set, {}, &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  const FitPoint found = problem.FitFromAfar();
  ASSERT_TRUE(found.ok) << found.message;

  constexpr double kLittle = 0.5;  // noise variances: less than a standard deviation of anything
  // From a stiffness that is wrong by some standard deviations.
  const std::map<std::string, double> wrong = {{"EI", 1.01 * found.ValueOf("EI")}};
  FitPoint without = found;
  without.jacobian = {};
  SimulationCount before = problem.count();
  const FitPoint anew = problem.FitFrom(without, wrong);
  const long all = (problem.count() - before).simulations;
  before = problem.count();
  const FitPoint kept = problem.FitFrom(found, wrong);
  const long fewer = (problem.count() - before).simulations;
  ASSERT_TRUE(anew.ok && kept.ok);
  EXPECT_LT(kept.cost, anew.cost + kLittle);
  EXPECT_NEAR(kept.ValueOf("EI"), anew.ValueOf("EI"), 1e-5 * anew.ValueOf("EI"));
  EXPECT_LT(fewer, all);
}

}  // namespace
}  // namespace cosserat_cable
