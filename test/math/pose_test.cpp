#include "cosserat_cable/math/pose.h"

#include <gtest/gtest.h>

#include "math/motion_reference.h"

namespace cosserat_cable {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kRounding = 1e-14;
constexpr double kStep = 1e-4;             // [s] of central differences
constexpr double kDifferenceError = 1e-5;  // step^2/6 and step^2/12 times derivatives below 1000

Pose PoseAB(double t) {
  return {{0.3 * std::sin(2 * t), 0.2 * t, 0.1 * t * t},
          AxisTurn({0, 0, 1}, 0.8 * std::sin(3 * t)) * AxisTurn({1, 0.2, 0}, 0.5 * t)};
}

Pose PoseBC(double t) {
  return {{0.5 + 0.1 * t, -0.2 * std::cos(4 * t), 0.3},
          AxisTurn({0.3, 1, 0}, 2 * t) * AxisTurn({0, 1, 1}, 0.4 * std::cos(2 * t))};
}

TEST(Pose, ComposesAndInverts) {
  const Pose X_AB = PoseAB(0.7), X_BC = PoseBC(0.7);
  const Vector3d p_C(0.1, -0.2, 0.3);
  EXPECT_LT(((X_AB * X_BC) * p_C - X_AB * (X_BC * p_C)).norm(), kRounding);
  const Pose identity = X_AB * X_AB.Inverse();
  EXPECT_LT(identity.p.norm(), kRounding);
  EXPECT_LT(identity.q.angularDistance(Quaterniond::Identity()), kRounding);
}

TEST(Motion, CompositionIsTheDerivativeOfTheComposedPose) {
  for (const double t : {-0.4, 0.0, 0.3, 1.7}) {
    const Motion composed =
        DifferencedMotion(PoseAB, t, kStep) * DifferencedMotion(PoseBC, t, kStep);
    const auto pose_ac = [](double time) { return PoseAB(time) * PoseBC(time); };
    const Motion reference = DifferencedMotion(pose_ac, t, kStep);
    EXPECT_LT((composed.X.p - reference.X.p).norm(), kRounding);
    EXPECT_LT((composed.v - reference.v).norm(), kDifferenceError);
    EXPECT_LT((composed.omega - reference.omega).norm(), kDifferenceError);
    EXPECT_LT((composed.a - reference.a).norm(), kDifferenceError);
    EXPECT_LT((composed.alpha - reference.alpha).norm(), kDifferenceError);
  }
}

TEST(Motion, RestingFrameAddsNoMotionOfItsOwn) {
  Motion spinning;
  spinning.omega = {0, 0, 2};  // about z of B: a point at 0.5 m runs at 1 m/s and 2 m/s^2
  const Motion point = spinning * Motion::Resting({{0.5, 0, 0}, Quaterniond::Identity()});
  EXPECT_LT((point.v - Vector3d(0, 1, 0)).norm(), kRounding);
  EXPECT_LT((point.a - Vector3d(-2, 0, 0)).norm(), kRounding);
  EXPECT_LT((point.omega - Vector3d(0, 0, 2)).norm(), kRounding);
  EXPECT_LT(point.alpha.norm(), kRounding);
}

}  // namespace
}  // namespace cosserat_cable
