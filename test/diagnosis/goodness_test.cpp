// Adequacy and differences on residuals whose statistics are known.
#include "../../src/diagnosis/goodness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../../src/diagnosis/held_out.h"

namespace cosserat_cable {
namespace {

/// AR(1) noise of unit variance.
Eigen::MatrixXd Noise(int rows, int columns, double correlation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd values(rows, columns);
  const double fresh = std::sqrt(1 - correlation * correlation);
  for (int c = 0; c < columns; ++c) {
    double last = normal(random);
    for (int i = 0; i < rows; ++i)
      values(i, c) = last = correlation * last + fresh * normal(random);
  }
  return values;
}

FitPoint PointOf(const Records& residuals) {
  FitPoint point;
  point.ok = true;
  point.residuals = residuals;
  for (const Eigen::MatrixXd& one : residuals) {
    point.cost += one.squaredNorm();
    point.samples += static_cast<double>(one.size());
    point.noise.push_back(Eigen::VectorXd::Ones(one.cols()));
  }
  point.values = Eigen::VectorXd::Zero(2);
  return point;
}

SetNoise Given(const Records& residuals) {
  SetNoise noise;
  for (const Eigen::MatrixXd& one : residuals) {
    noise.levels.push_back(Eigen::VectorXd::Ones(one.cols()));
    NoiseLevel level;
    level.source = NoiseLevel::Source::kGiven;
    level.sd = 1;
    level.freedom = std::numeric_limits<double>::infinity();
    noise.sources.push_back(std::vector<NoiseLevel>(static_cast<std::size_t>(one.cols()), level));
  }
  return noise;
}

TEST(AdequacyTest, NoiseIsAdequateAndTwiceTheNoiseIsNot) {
  for (const double correlation : {0.0, 0.7}) {
    const Records noise = {Noise(2000, 2, correlation, 1), Noise(500, 1, correlation, 2)};
    EXPECT_TRUE(AdequacyOf(PointOf(noise), Given(noise)).adequate) << correlation;
    Records twice = noise;
    for (Eigen::MatrixXd& one : twice) one *= 2;
    EXPECT_FALSE(AdequacyOf(PointOf(twice), Given(twice)).adequate) << correlation;
  }
}

TEST(AdequacyTest, WhatIsLeftIsJudgedByTheNoiseThatIsKnownNow) {
  Records twice = {Noise(2000, 2, 0, 1)};
  twice[0] *= 2;
  SetNoise larger = Given(twice);
  larger.levels[0] *= 2;
  EXPECT_TRUE(AdequacyOf(PointOf(twice), larger).adequate);
  EXPECT_NEAR(AdequacyOf(PointOf(twice), larger).chi2, twice[0].squaredNorm() / 4, 1e-9);
}

TEST(AdequacyTest, ColourWidensTheSpread) {
  // Of n samples with autocorrelation r^k the sum of squares has the variance 2n(1+r^2)/(1-r^2).
  constexpr int kRows = 4000;
  constexpr double kColour = 0.8, kTolerance = 0.2;  // an estimated colour is as good as that
  const Records noise = {Noise(kRows, 1, kColour, 3)};
  const double expected = std::sqrt(2 * kRows * (1 + kColour * kColour) / (1 - kColour * kColour));
  EXPECT_NEAR(AdequacyOf(PointOf(noise), Given(noise)).sd / expected, 1, kTolerance);
}

TEST(DifferenceTest, CountsCorrelatedSamplesOnce) {
  const Records better = {Eigen::MatrixXd::Zero(80, 1)};
  const Records worse = {Eigen::MatrixXd::Ones(80, 1)};
  const Difference white = DifferenceOf(worse, better, {Eigen::VectorXd::Constant(1, 1.0)});
  const Difference coloured = DifferenceOf(worse, better, {Eigen::VectorXd::Constant(1, 4.0)});
  EXPECT_DOUBLE_EQ(white.value, 80);
  EXPECT_DOUBLE_EQ(coloured.value, 20);
  EXPECT_NEAR(white.se, 0, 1e-9);  // the same in every block
}

TEST(DifferenceTest, AStretchHasALargeError) {
  const Records better = {Eigen::MatrixXd::Zero(80, 1)};
  Records worse = better;
  worse[0].topRows(10).setOnes();
  const Difference one = DifferenceOf(worse, better, {Eigen::VectorXd::Ones(1)});
  EXPECT_DOUBLE_EQ(one.value, 10);
  EXPECT_NEAR(one.se, 10, 1e-9);  // one of eight blocks has it all
}

TEST(DifferenceTest, WhatOneShortRecordGainsIsNotLostInTheOthers) {
  const Records better = {Eigen::MatrixXd::Zero(800, 2), Eigen::MatrixXd::Zero(11, 1)};
  Records worse = better;
  worse[1].setConstant(2);
  const Correlations white = {Eigen::VectorXd::Ones(2), Eigen::VectorXd::Ones(1)};
  EXPECT_DOUBLE_EQ(DifferenceOf(worse, better, white).most_per_sample, 4);
  EXPECT_DOUBLE_EQ(DifferenceOf(better, worse, white).most_per_sample, 0);
}

TEST(GainTest, IsThePartOfTheMisfitThatIsGone) {
  // Misfits of 3 and 1 times the noise, independent of it: gain (9 - 1)/9.
  constexpr double kTolerance = 0.03;  // the noise's own chance in 4000 samples
  const Eigen::MatrixXd noise = Noise(4000, 1, 0, 5), signal = Noise(4000, 1, 0, 6);
  const auto gain = GainOf({noise + 3 * signal}, {noise + signal});
  ASSERT_TRUE(gain);
  EXPECT_NEAR(gain->value, 8.0 / 9, kTolerance);
  EXPECT_LT(gain->low, 8.0 / 9);
  EXPECT_GT(gain->high, 8.0 / 9);
  EXPECT_NEAR(gain->rms_baseline, std::sqrt(10.0), kTolerance * std::sqrt(10.0));
}

TEST(GainTest, ThereIsNoneBesideNoise) {
  const Eigen::MatrixXd noise = Noise(1000, 1, 0, 7);
  EXPECT_FALSE(GainOf({0.99 * noise / std::sqrt(noise.squaredNorm() / 1000)}, {noise}));
  EXPECT_FALSE(GainOf({Eigen::MatrixXd()}, {Eigen::MatrixXd()}));
}

// Of linear models: residuals of a record by a fit without it are known in closed form.
TEST(HeldOutTest, IsTheFitWithoutTheRecord) {
  // Two records of a constant each, one common unknown: y = theta, three and one samples.
  FitPoint point;
  point.unknowns.resize(1);
  point.values = Eigen::VectorXd::Zero(1);
  const double first = 1.0, second = 5.0, all = (3 * first + second) / 4;
  point.residuals = {Eigen::MatrixXd::Constant(3, 1, first - all),
                     Eigen::MatrixXd::Constant(1, 1, second - all)};
  RecordJacobian::Record a, b;
  a.unknowns = b.unknowns = {0};
  a.columns = Eigen::MatrixXd::Constant(3, 1, -1);
  b.columns = Eigen::MatrixXd::Constant(1, 1, -1);
  point.jacobian = RecordJacobian({a, b}, Eigen::VectorXd::Zero(1));
  const Records predicted = LinearisedHeldOut(point);
  EXPECT_NEAR(predicted[0](0, 0), first - second, 1e-9);
  EXPECT_NEAR(predicted[1](0, 0), second - first, 1e-9);
}

}  // namespace
}  // namespace cosserat_cable
