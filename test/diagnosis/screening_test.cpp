// Which two hypotheses promise most together.
#include "../../src/diagnosis/screening.h"

#include <gtest/gtest.h>

namespace cosserat_cable {
namespace {

constexpr double kRounding = 1e-6;  // of the ridge on the normal equations

/// A hypothesis with one component that does this to four samples, at a point that leaves `left`.
Screened Hypothesis(const std::string& cause, const Eigen::Vector4d& effect,
                    const Eigen::Vector4d& left, bool one_sided = false,
                    const std::string& number = "size") {
  Screened one;
  one.trial.cause = cause;
  one.trial.components.emplace_back();
  one.trial.components.back().numbers = {{cause + "." + number}};
  one.trial.components.back().one_sided = one_sided;
  one.effects = {effect};
  one.parts = {Eigen::VectorXd::Zero(1)};
  one.gradient = {effect.dot(left)};
  return one;
}

TEST(ScreenPairs, AddWhatOrthogonalEffectsExplain) {
  const Eigen::Vector4d left(3, 4, 0, 0);
  const std::vector<ScreenedPair> pairs =
      ScreenPairs({Hypothesis("drag", {0, 2, 0, 0}, left), Hypothesis("mass", {1, 0, 0, 0}, left),
                   Hypothesis("clock", {0, 0, 1, 0}, left)});
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].first, 0u);
  EXPECT_EQ(pairs[0].second, 1u);
  EXPECT_NEAR(pairs[0].drop, 9 + 16, 25 * kRounding);
  EXPECT_NEAR(pairs[1].drop, 16, 16 * kRounding);
}

TEST(ScreenPairs, AreOfTwoCausesAndTheBestOfEach) {
  const Eigen::Vector4d left(1, 1, 1, 0);
  const std::vector<ScreenedPair> pairs =
      ScreenPairs({Hypothesis("drag", {1, 1, 0, 0}, left), Hypothesis("drag", {0, 0, 1, 0}, left),
                   Hypothesis("mass", {0, 0, 2, 0}, left)});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].first, 0u);
  EXPECT_EQ(pairs[0].second, 2u);
  EXPECT_NEAR(pairs[0].drop, 3, 3 * kRounding);
}

TEST(ScreenPairs, AreOfOneCauseWhereItsWaysShareNoNumber) {
  const Eigen::Vector4d left(1, 1, 0, 0);
  const std::vector<ScreenedPair> pairs =
      ScreenPairs({Hypothesis("clamp", {1, 0, 0, 0}, left, false, "tilt"),
                   Hypothesis("clamp", {0, 1, 0, 0}, left, false, "phase")});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0].drop, 2, 2 * kRounding);
}

TEST(ScreenPairs, CannotTakeAwayOfAOneSidedEffect) {
  const Eigen::Vector4d left(1, -1, 0, 0);
  const std::vector<ScreenedPair> pairs = ScreenPairs(
      {Hypothesis("drag", {0, 1, 0, 0}, left, true), Hypothesis("mass", {1, 0, 0, 0}, left)});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0].drop, 1, kRounding);
}

}  // namespace
}  // namespace cosserat_cable
