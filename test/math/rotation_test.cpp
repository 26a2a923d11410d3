#include "cosserat_cable/math/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "math/motion_reference.h"

namespace cosserat_cable {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kRounding = 1e-14;  // a few operations on numbers of order one
// Near half a turn the logarithm's direction is the quotient of well-conditioned numbers still, but
// 1 - cos is subtracted once.
constexpr double kInverseRounding = 1e-12;
constexpr double kStep = 1e-4;             // [s] of central differences
constexpr double kDifferenceError = 3e-6;  // step^2 times third derivatives of order 100, and
                                           // rounding 1e-16/step^2 = 1e-8

/// Vectors at and near zero, at the switch between series and closed form, up to half a turn.
std::vector<Vector3d> Samples(double longest) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<Vector3d> samples = {Vector3d::Zero()};
  for (const double length : {1e-300, 1e-12, 1e-6, 1e-3, 2.1e-3, 0.1, 0.2999999, 0.3000001, 1.0,
                              2.0, 3.0, 3.14, 4.0, 6.0}) {
    if (length > longest) continue;
    for (int i = 0; i < 5; ++i) {
      samples.push_back(length *
                        Vector3d(normal(random), normal(random), normal(random)).normalized());
    }
  }
  return samples;
}

/// The rotation's power series, summed: independent of every closed form.
Matrix3d ExpSeries(const Vector3d& phi) {
  Matrix3d hat;
  hat << 0, -phi.z(), phi.y(), phi.z(), 0, -phi.x(), -phi.y(), phi.x(), 0;
  Matrix3d sum = Matrix3d::Identity(), term = Matrix3d::Identity();
  for (int k = 1; k < 60; ++k) {
    term = term * hat / k;
    sum += term;
  }
  return sum;
}

/// J_r(phi) = sum_k (-[phi])^k / (k + 1)!.
Matrix3d JacobianSeries(const Vector3d& phi) {
  Matrix3d hat;
  hat << 0, -phi.z(), phi.y(), phi.z(), 0, -phi.x(), -phi.y(), phi.x(), 0;
  Matrix3d sum = Matrix3d::Identity(), term = Matrix3d::Identity();
  for (int k = 1; k < 60; ++k) {
    term = term * -hat / (k + 1);
    sum += term;
  }
  return sum;
}

TEST(Rotation, ExpIsThePowerSeries) {
  constexpr double kSeriesRounding = 1e-13;  // terms up to 6^6/6! = 65 cancel
  for (const Vector3d& phi : Samples(6.5)) {
    const Quaterniond q = RotationExp(phi);
    EXPECT_NEAR(q.norm(), 1, kRounding);
    EXPECT_LT((q.toRotationMatrix() - ExpSeries(phi)).norm(), kSeriesRounding) << phi.transpose();
  }
}

TEST(Rotation, LogInvertsExp) {
  for (const Vector3d& phi : Samples(3.141)) {
    const Quaterniond q = RotationExp(phi);
    EXPECT_LT((RotationLog(q) - phi).norm(), kRounding + kRounding * phi.norm());
    EXPECT_LT((RotationLog(Quaterniond(-q.coeffs())) - phi).norm(), kRounding * (1 + phi.norm()));
  }
}

TEST(Rotation, LogIsTheShortestBeyondHalfATurn) {
  const Vector3d axis = Vector3d(1, 2, -2) / 3;
  EXPECT_LT((RotationLog(RotationExp(4.0 * axis)) - (4.0 - 2 * M_PI) * axis).norm(), kRounding);
  EXPECT_NEAR(RotationLog(Quaterniond(0, 1, 0, 0)).norm(), M_PI, kRounding);
}

TEST(Rotation, ShortestTurnTurnsWithoutTwist) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    const Vector3d from(normal(random), normal(random), normal(random));
    const Vector3d other(normal(random), normal(random), normal(random));
    for (const Vector3d& to : {other, from, Vector3d(-from), Vector3d(-from + 1e-9 * other)}) {
      const Quaterniond q = ShortestTurn(from, to);
      EXPECT_NEAR(q.norm(), 1, kRounding);
      // Of nearly opposite directions half of the way is a small difference.
      const double half = (from.normalized() + to.normalized()).norm();
      const double within = half > 0 ? 10 * kRounding / half : kRounding;
      EXPECT_LT((q * from.normalized() - to.normalized()).norm(), within);
      EXPECT_NEAR(q.vec().dot(from), 0, kRounding * from.norm());
    }
  }
}

TEST(Rotation, RightJacobianIsItsSeries) {
  constexpr double kSeriesRounding = 1e-13;
  for (const Vector3d& phi : Samples(6.5)) {
    EXPECT_LT((RightJacobian(phi) - JacobianSeries(phi)).norm(), kSeriesRounding)
        << phi.transpose();
  }
}

TEST(Rotation, RightJacobianInverseInverts) {
  for (const Vector3d& phi : Samples(4.5)) {
    EXPECT_LT((RightJacobianInverse(phi) * RightJacobian(phi) - Matrix3d::Identity()).norm(),
              kInverseRounding)
        << phi.transpose();
  }
}

TEST(Rotation, BodyRatesAreThoseOfTheRotation) {
  const Vector3d b(0.7, -1.1, 0.4), c(-2.0, 0.3, 1.5);
  for (const Vector3d& phi : Samples(4.5)) {
    const auto pose_at = [&](double t) {
      return Pose{Vector3d::Zero(), Quaterniond(ExpSeries(phi + t * b + 0.5 * t * t * c))};
    };
    const Motion reference = DifferencedMotion(pose_at, 0, kStep);
    const BodyRates rates = ToBodyRates(phi, {b, c});
    EXPECT_LT((rates.omega - reference.omega).norm(), kDifferenceError) << phi.transpose();
    EXPECT_LT((rates.alpha - reference.alpha).norm(), kDifferenceError) << phi.transpose();
  }
}

TEST(Rotation, ChartRatesInvertBodyRates) {
  const Vector3d b(0.7, -1.1, 0.4), c(-2.0, 0.3, 1.5);
  for (const Vector3d& phi : Samples(4.5)) {
    const ChartRates chart = ToChartRates(phi, ToBodyRates(phi, {b, c}));
    EXPECT_LT((chart.d_phi - b).norm(), kInverseRounding) << phi.transpose();
    EXPECT_LT((chart.dd_phi - c).norm(), 10 * kInverseRounding) << phi.transpose();
  }
}

}  // namespace
}  // namespace cosserat_cable
