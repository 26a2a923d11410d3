// The fast sums against the sums as they are written.

#include "../../src/identification/uneven_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

namespace cosserat_cable {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Of the sum of sizes: what the header promises.
constexpr double kPromised = 1e-10;

void Compare(Eigen::Index samples, Eigen::Index count, double longest_phase) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> phases(0, longest_phase);
  std::normal_distribution<double> values;
  const Eigen::ArrayXd phase =
      Eigen::ArrayXd::NullaryExpr(samples, [&](Eigen::Index) { return phases(random); });
  const Eigen::ArrayXd x =
      Eigen::ArrayXd::NullaryExpr(samples, [&](Eigen::Index) { return values(random); });
  const Eigen::ArrayXcd sums = UnevenTransform(phase, x, count);
  ASSERT_EQ(sums.size(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    std::complex<double> sum = 0;
    for (Eigen::Index j = 0; j < samples; ++j)
      sum += x[j] * std::polar(1.0, -(static_cast<double>(k) + 0.5) * phase[j]);
    EXPECT_LT(std::abs(sums[k] - sum), kPromised * x.abs().sum()) << "frequency " << k;
  }
}

TEST(UnevenTransform, OfOddAndEvenCounts) {
  Compare(500, 499, kPi);
  Compare(500, 500, kPi);
}

TEST(UnevenTransform, OfAllPhases) { Compare(300, 256, 2 * kPi); }

TEST(UnevenTransform, OfFewFrequencies) {
  for (const Eigen::Index count : {1, 2, 3, 15, 16}) Compare(16, count, kPi);
}

TEST(UnevenTransform, OfOneValueAtZero) {
  // Its sum is the value itself at each frequency.
  const Eigen::ArrayXcd sums =
      UnevenTransform(Eigen::ArrayXd::Zero(1), Eigen::ArrayXd::Constant(1, 3.0), 40);
  EXPECT_LT((sums - 3.0).abs().maxCoeff(), 3 * kPromised);
}

}  // namespace
}  // namespace cosserat_cable
