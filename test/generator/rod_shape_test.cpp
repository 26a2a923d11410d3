#include "rod_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "legendre.h"

namespace cosserat_cable::generator {
namespace {

constexpr double kRounding = 1e-13;
// A helix over a full turn on the default nodes; Magnus of order six is exact where K is constant.
constexpr double kExactRotation = 1e-12;

TEST(Legendre, GaussRuleIsExactToItsDegree) {
  const GaussRule rule = gaussRule(7);
  for (int degree = 0; degree <= 13; ++degree) {
    const double sum = (rule.weights.array() * rule.nodes.array().pow(degree)).sum();
    EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1.0) : 0.0, kRounding) << degree;
  }
}

TEST(Legendre, IntegralFromTheLeftIsExactForPolynomials) {
  const GaussRule rule = gaussRule(6);
  for (int degree = 0; degree < 6; ++degree) {
    const Eigen::VectorXd values = rule.nodes.array().pow(degree);
    for (double x : {-1.0, -0.3, 0.4, 1.0}) {
      const double exact = (std::pow(x, degree + 1) - std::pow(-1.0, degree + 1)) / (degree + 1.0);
      EXPECT_NEAR(integralFromLeft(rule, x).dot(values), exact, kRounding) << degree;
    }
  }
}

TEST(RodShape, ElementsIntegrateAsOne) {
  const RodShape whole(0.5, {}, Resolution()), parts(0.5, {0.4, 0.1, 0.5}, Resolution());
  EXPECT_EQ(parts.elements(), 3);
  EXPECT_EQ(parts.endPoint(0.4), parts.nodes() + 1);
  EXPECT_THROW(parts.endPoint(0.3), std::invalid_argument);
  EXPECT_THROW(parts.integralTo(0.51), std::invalid_argument);
  // The arc length itself, integrated twice, is s^2/2.
  for (const RodShape* shape : {&whole, &parts}) {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(shape->nodes());
    const Eigen::VectorXd s = (shape->integral() * ones).head(shape->nodes());
    for (double to : {0.05, 0.1, 0.33, 0.5}) {
      EXPECT_NEAR(shape->integralTo(to).dot(s), 0.5 * to * to, kRounding);
    }
  }
}

TEST(RodShape, ConstantCurvatureTurnsAboutAFixedAxis) {
  const RodShape shape(1.0, {0.3}, Resolution());
  Eigen::VectorXd q = Eigen::VectorXd::Zero(shape.size());
  const Eigen::Vector3d K(2.0, -1.0, 5.0);
  for (int c = 0; c < 3; ++c) {  // P_0 of both elements
    q[shape.offset(c)] = K[c];
    q[shape.offset(c) + shape.count(c) / 2] = K[c];
  }
  Eigen::Matrix3Xd frames;
  shape.rotations(q, &frames);
  const Eigen::Matrix3d end = frames.rightCols<3>();
  EXPECT_NEAR((end * K.normalized() - K.normalized()).norm(), 0.0, kExactRotation);
  EXPECT_NEAR(end.trace(), 1.0 + 2.0 * std::cos(K.norm()), kExactRotation);
}

}  // namespace
}  // namespace cosserat_cable::generator
