// Least squares through the Gram matrix against a decomposition that does not square conditions.

#include "../../src/identification/column_span.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

namespace cosserat_cable {
namespace {

// Of the columns' condition times the arithmetic's precision, with two digits to spare.
constexpr double kDigitsToSpare = 100 * 2.3e-16;

struct Case {
  Eigen::MatrixXd columns;
  Eigen::VectorXd y;
};

// A constant, a drift and two oscillations whose frequencies differ by `apart`, over 400 samples.
Case MakeCase(double apart) {
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(400, 0, 1);
  Case made{Eigen::MatrixXd(400, 4), (3 * t).exp() + 5e-4 * (211 * t).sin()};
  made.columns << Eigen::VectorXd::Ones(400), 1e6 * t, (20 * t).sin(), ((20 + apart) * t).sin();
  return made;
}

void Compare(const Case& is) {
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(
      is.columns * is.columns.colwise().norm().cwiseInverse().asDiagonal(),
      Eigen::ComputeThinU | Eigen::ComputeThinV);
  const double condition = svd.singularValues()[0] / svd.singularValues()[3];
  const double precision = kDigitsToSpare * condition;
  const Eigen::VectorXd scale = is.columns.colwise().norm();
  const ColumnSpan span(is.columns);
  const Eigen::VectorXd expected = svd.solve(is.y);
  const Eigen::VectorXd found = scale.asDiagonal() * span.Solve(is.y);
  EXPECT_LT((found - expected).norm(), precision * condition * is.y.norm());
  const Eigen::VectorXd left = is.y - svd.matrixU() * (svd.matrixU().transpose() * is.y);
  Eigen::VectorXd is_left = is.y;
  span.Leave(is_left);
  EXPECT_LT((is_left - left).norm(), precision * is.y.norm());
  const double determinant =
      2 * (svd.singularValues().array().log().sum() + scale.array().log().sum());
  EXPECT_NEAR(span.LogDeterminantOfGram(), determinant, precision * condition);
}

TEST(ColumnSpan, OfColumnsThatDiffer) { Compare(MakeCase(5)); }

TEST(ColumnSpan, OfColumnsThatAreNearlyDependent) {
  Compare(MakeCase(1e-3));
  Compare(MakeCase(1e-7));  // whose Gram matrix has no digit left
}

}  // namespace
}  // namespace cosserat_cable
