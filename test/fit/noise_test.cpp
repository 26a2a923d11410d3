#include "cosserat_cable/fit/noise.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace cosserat_cable {
namespace {

constexpr int kSamples = 4000;

/// Noise in which each sample keeps the part `rho` of the last one; of standard deviation 1.
Eigen::VectorXd Correlated(double rho, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise(kSamples);
  double last = normal(random);
  for (int i = 0; i < kSamples; ++i) {
    noise[i] = last;
    last = rho * last + std::sqrt(1 - rho * rho) * normal(random);
  }
  return noise;
}

TEST(NoiseTest, TheNoiseOfASmoothSignalIsSeenThroughIt) {
  // 5 Hz at 1 kHz, a hundred times the noise. The median of 4000 correlated differences is good to
  // some 3 %.
  constexpr double kTolerance = 0.1;
  Eigen::VectorXd y = 0.01 * Correlated(0, 1);
  for (int i = 0; i < kSamples; ++i) y[i] += std::sin(2 * 3.141592653589793 * 5 * i * 1e-3);
  EXPECT_NEAR(NoiseOfSmooth(y), 0.01, kTolerance * 0.01);
}

TEST(NoiseTest, WhiteNoiseIsNotTakenForColoured) {
  // Schwarz's criterion takes one order too many in few cases: little correlation then.
  for (std::uint32_t seed = 1; seed <= 20; ++seed)
    EXPECT_NEAR(ColourOf(2.0 * Correlated(0, seed)).correlation_samples, 1.0, 0.3) << seed;
}

TEST(NoiseTest, TheColourOfNoiseIsFound) {
  // (1 + rho)/(1 - rho) samples are worth one; of 4000 with rho 0.7, rho is good to 0.011 and the
  // ratio to 7 %.
  constexpr double kTolerance = 0.25;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const NoiseColour colour = ColourOf(3.0 * Correlated(0.7, seed));
    EXPECT_NEAR(colour.sd, 3.0, 0.2);
    EXPECT_NEAR(colour.correlation_samples, 1.7 / 0.3, kTolerance * 1.7 / 0.3) << seed;
    EXPECT_NEAR(colour.autocorrelation[1], 0.7, 0.05);
  }
}

TEST(NoiseTest, WhitenedResidualsAreWhite) {
  const Eigen::VectorXd noise = 3.0 * Correlated(0.7, 5);
  const NoiseColour colour = ColourOf(noise);
  const Whitened white = Whiten(noise, colour, colour.sd);
  // Of 4000: a standard deviation of 0.011 of the variance's root, 0.016 of a correlation.
  EXPECT_NEAR(white.residuals.norm() / std::sqrt(kSamples), 1.0, 0.04);
  const double next = white.residuals.head(kSamples - 1).dot(white.residuals.tail(kSamples - 1));
  EXPECT_NEAR(next / kSamples, 0.0, 0.05);
}

TEST(NoiseTest, TheLikelihoodIsThatOfAllSamplesTogether) {
  // By the covariance matrix of the whole: -(r' C^-1 r + log det C + n log 2 pi)/2.
  NoiseColour colour;
  colour.order = 1;
  constexpr double kRho = 0.6, kSd = 0.2;
  constexpr int kFew = 12;
  for (int k = 0; k <= kFew; ++k) colour.autocorrelation.push_back(std::pow(kRho, k));
  const Eigen::VectorXd r = 0.2 * Correlated(0.3, 2).head(kFew);
  Eigen::MatrixXd C(kFew, kFew);
  for (int i = 0; i < kFew; ++i)
    for (int k = 0; k < kFew; ++k) C(i, k) = kSd * kSd * std::pow(kRho, std::abs(i - k));
  const double expected =
      -0.5 * (r.dot(C.inverse() * r) + std::log(C.determinant()) + kFew * std::log(2 * M_PI));
  EXPECT_NEAR(Whiten(r, colour, kSd).log_likelihood, expected, 1e-9 * std::abs(expected));
}

}  // namespace
}  // namespace cosserat_cable
