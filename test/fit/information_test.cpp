#include "cosserat_cable/fit/information.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cosserat_cable {
namespace {

constexpr double kRounding = 1e-12;

TEST(InformationTest, CovarianceOfTwoThatWhiteNoiseLetsSee) {
  // By hand: the inverse of [[4, 2], [2, 3]] is [[3, -2], [-2, 4]]/8.
  Eigen::Matrix2d expected;
  expected << 4, 2, 2, 3;
  const Eigen::MatrixXd covariance = CovarianceOf({expected, expected}, {0, 1});
  EXPECT_NEAR(covariance(0, 0), 3.0 / 8, kRounding);
  EXPECT_NEAR(covariance(1, 1), 4.0 / 8, kRounding);
  EXPECT_NEAR(covariance(0, 1), -2.0 / 8, kRounding);
}

TEST(InformationTest, ColourOfTheNoiseWidens) {
  Eigen::Matrix2d expected;
  expected << 4, 2, 2, 3;
  const Eigen::MatrixXd covariance = CovarianceOf({expected, 9 * expected}, {0, 1});
  EXPECT_NEAR(covariance(0, 0), 9 * 3.0 / 8, 9 * kRounding);
}

TEST(InformationTest, TwoThatOnlyTheirSumIsSeenOfAreUnknownWhateverRoundingLeaves) {
  const Eigen::Matrix2d expected = Eigen::Matrix2d::Ones();
  Eigen::Matrix2d scatter = expected;
  scatter(0, 0) -= 1e-9;  // a variance below zero along (1, -1)
  const Eigen::MatrixXd covariance = CovarianceOf({expected, scatter}, {0, 1});
  for (const int i : {0, 1}) {
    EXPECT_TRUE(std::isfinite(std::sqrt(covariance(i, i))));
    EXPECT_GT(covariance(i, i), 1e6);
  }
  // The sum is known as one number is: 1/1.
  EXPECT_NEAR(covariance.sum(), 1.0, 1e-3);
}

}  // namespace
}  // namespace cosserat_cable
