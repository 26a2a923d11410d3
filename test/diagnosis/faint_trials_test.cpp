// A hypothesis that grows from nothing is nothing where it is faint: otherwise what a screening
// shows of it is a jump, and not the cause.
#include <gtest/gtest.h>

#include "../../src/diagnosis/motion_scales.h"
#include "../../src/diagnosis/trial.h"
#include "cosserat_cable/fit/fit_problem.h"
#include "pulled_set.h"

namespace cosserat_cable {
namespace {

constexpr double kFaint = 1e-3, kLess = 1e-3;  // of a typical size, and of that
// What is left of a faint effect, by the effect: of laws that are not linear it is less, and with
// rounding a little more, than kLess.
constexpr double kLeft = 0.05;
// Of the noise's standard deviation, rms over the samples: rounding and the steps' own error.
constexpr double kRounding = 1e-3;

TEST(FaintTrials, AreNearlyNothing) {
  const MeasurementSet set = testing::Pulled(0.06, testing::CableSpecimen());
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
        effect[k] =
            moved.norm() / std::sqrt(static_cast<double>(moved.size())) / testing::kPulledNoise;
      }
      EXPECT_LT(effect[1], kLeft * effect[0] + kRounding)
          << trial.cause << " " << component.numbers.front().path;
      ++tried;
    }
  EXPECT_GT(tried, 40);
}

}  // namespace
}  // namespace cosserat_cable
