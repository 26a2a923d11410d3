#include "../../src/rod/block_tridiagonal.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace cosserat_cable::rod {
namespace {

constexpr int kNodes = 9;

struct Case {
  BlockTridiagonal<double> system{kNodes};
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(6 * kNodes, 6 * kNodes);
};

/// Positive definite by diagonal dominance, or indefinite where `shift` takes too much away.
Case MakeCase(double shift) {
  std::mt19937 rng(3);
  std::normal_distribution<double> normal;
  Case c;
  for (int i = 0; i < kNodes; ++i) {
    for (int r = 0; r < 6; ++r)
      for (int k = 0; k <= r; ++k) {
        const double value = normal(rng) + (r == k ? 30.0 - shift : 0.0);
        c.system.diagonal(i)[r][k] = value;
        c.dense(6 * i + r, 6 * i + k) = c.dense(6 * i + k, 6 * i + r) = value;
      }
    if (i == kNodes - 1) break;
    for (int r = 0; r < 6; ++r)
      for (int k = 0; k < 6; ++k) {
        const double value = normal(rng);
        c.system.lower(i)[r][k] = value;
        c.dense(6 * (i + 1) + r, 6 * i + k) = c.dense(6 * i + k, 6 * (i + 1) + r) = value;
      }
  }
  return c;
}

TEST(BlockTridiagonalTest, SolvesLikeADenseFactorisation) {
  constexpr double kTolerance = 1e-13;  // condition number of about 3
  for (const auto& range : {std::pair<int, int>{0, kNodes - 1}, {1, kNodes - 2}}) {
    Case c = MakeCase(0);
    const int first = range.first, count = range.second - first + 1;
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(6 * kNodes, -1, 2);
    std::vector<Vec6<double>> x(kNodes);
    for (int i = 0; i < kNodes; ++i)
      for (int k = 0; k < 6; ++k) x[i][k] = b[6 * i + k];
    EXPECT_GT(c.system.Factorise(first, range.second), 0);
    c.system.Solve(x.data());
    const Eigen::VectorXd expected = c.dense.block(6 * first, 6 * first, 6 * count, 6 * count)
                                         .lu()
                                         .solve(b.segment(6 * first, 6 * count));
    for (int i = 0; i < count; ++i)
      for (int k = 0; k < 6; ++k) EXPECT_NEAR(x[first + i][k], expected[6 * i + k], kTolerance);
  }
}

TEST(BlockTridiagonalTest, ReportsAnIndefiniteMatrix) {
  Case c = MakeCase(27);
  ASSERT_LT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(c.dense).eigenvalues().minCoeff(), 0);
  EXPECT_LE(c.system.Factorise(0, kNodes - 1), 0);
}

}  // namespace
}  // namespace cosserat_cable::rod
