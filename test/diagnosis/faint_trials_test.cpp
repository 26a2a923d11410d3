// A hypothesis that grows from nothing is nothing where it is faint: otherwise what a screening
// shows of it is a jump, and not the cause.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "../../src/diagnosis/motion_scales.h"
#include "../../src/diagnosis/trial.h"
#include "../measurement/rigs.h"
#include "cosserat_cable/fit/fit_problem.h"

namespace cosserat_cable {
namespace {

constexpr double kNoise = 2e-5;                // [m]
constexpr double kFaint = 1e-3, kLess = 1e-3;  // of a typical size, and of that
// What is left of a faint effect, by the effect: of laws that are not linear it is less, and with
// rounding a little more, than kLess.
constexpr double kLeft = 0.05;
// Of the noise's standard deviation, rms over the samples: rounding and the steps' own error.
constexpr double kRounding = 1e-3;

MeasurementSet Pulled() {
  MeasurementSet set;
  Problems problems;
  MapReader map(YamlValue::Root("set",
                                YAML::Load("length: 0.25\ndiameter: 0.006\nmass_per_length: 0.05\n"
                                           "EI: 0.003\nGJ: 0.0019\neta_EI: 1.0e-5\neta_GJ: 4.0e-6\n"
                                           "uncertain: [EI, eta_EI]\n"),
                                &problems));
  set.cable = ReadCableKeys(&map);
  EXPECT_TRUE(problems.empty()) << problems.ToString();
  Experiment experiment = testing::RingDown(0.06, 0.5, 101);
  experiment.channels[0].sigma = kNoise;
  const SimulatedRecord record = SimulateRefined(experiment, testing::CableSpecimen(), {}).record;
  EXPECT_TRUE(record.ok) << record.message;
  experiment.record.values = record.values;
  set.experiments = {experiment};
  return set;
}

TEST(FaintTrials, AreNearlyNothing) {
  const MeasurementSet set = Pulled();
  Problems problems;
  FitProblem problem(set, {}, &problems);
  ASSERT_TRUE(problems.empty()) << problems.ToString();
  const FitPoint plain = problem.At(problem.unknowns().StartValues());
  ASSERT_TRUE(plain.ok) << plain.message;
  int tried = 0;
  for (const Trial& trial : AllTrials(set, FindMotionScales(problem, plain)))
    for (const TrialComponent& component : trial.components) {
      // What acts beside its sizes is compared with itself.
      if (!component.grows() || component.acts_beside()) continue;
      const std::vector<RecordModel::Simulated> found = problem.model().SimulateWith(
          plain.values,
          {{component.At(kFaint), trial.channels}, {component.At(kFaint * kLess), trial.channels}});
      ASSERT_EQ(found.size(), 2u);
      double effect[2] = {0, 0};
      for (int k = 0; k < 2; ++k) {
        ASSERT_TRUE(found[k].ok) << trial.cause << ": " << found[k].message;
        const Eigen::MatrixXd moved = found[k].records[0] - plain.simulated[0];
        effect[k] = moved.norm() / std::sqrt(static_cast<double>(moved.size())) / kNoise;
      }
      EXPECT_LT(effect[1], kLeft * effect[0] + kRounding)
          << trial.cause << " " << component.numbers.front().path;
      ++tried;
    }
  EXPECT_GT(tried, 40);
}

}  // namespace
}  // namespace cosserat_cable
