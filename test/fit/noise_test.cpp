#include "cosserat_cable/fit/noise.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace cosserat_cable
