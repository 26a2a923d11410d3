#include "cosserat_cable/vehicle/motion_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/motion_reference.h"

namespace cosserat_cable {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Pose BodyInMap(double t) {
  return {{14 * t, 0.1 * std::sin(5 * t), 0.02 * std::sin(12 * t)},
          AxisTurn({0, 0, 1}, 0.2 * t) * AxisTurn({0, 1, 0}, 0.03 * std::sin(8 * t))};
}
Pose ArmInBody(double t) { return {{1.3, 0.4, 0}, AxisTurn({1, 0, 0}, 0.2 * std::sin(20 * t))}; }
Pose CarrierInArm(double t) {
  return {{0, 0.35, 0.01 * std::sin(25 * t)}, AxisTurn({0, 0.1, 1}, 0.3 * std::sin(4 * t))};
}
const Pose kSensorInCarrier = {{0.1, -0.2, 0.05}, AxisTurn({1, 1, 0}, 0.7)};

/// Three moving edges at 50, 100 and 500 Hz with starts of their own, and a fixed one.
MotionTree MakeChain(double duration) {
  MotionTree tree;
  EXPECT_TRUE(tree.SetFixed("carrier", "sensor", kSensorInCarrier));
  const auto fill = [&](const char* parent, const char* child, double begin, double rate,
                        const auto& pose_at) {
    for (int i = 0; begin + i / rate < duration; ++i) {
      const double t = begin + i / rate;
      EXPECT_TRUE(tree.Append(parent, child, t, pose_at(t)));
    }
  };
  fill("map", "body", 0.003, 50, BodyInMap);
  fill("body", "arm", 0.05, 100, ArmInBody);
  fill("arm", "carrier", 0.0117, 500, CarrierInArm);
  return tree;
}

TEST(MotionTree, ComposesAChainOfDifferentRates) {
  // The reference is differenced from the analytic poses; 50 Hz of a 2 Hz motion limits the curve.
  constexpr double kStep = 1e-4;  // [s]
  constexpr double kPosition = 1e-6, kVelocity = 5e-5,
                   kAcceleration = 5e-3;  // [m], [rad], 1/s, 1/s^2
  MotionTree tree = MakeChain(2);
  tree.Finish();
  const auto pose_at = [](double t) {
    return BodyInMap(t) * ArmInBody(t) * CarrierInArm(t) * kSensorInCarrier;
  };
  for (double t = 0.4; t < 1.6; t += 0.0037) {
    const Motion motion = tree.Evaluate("map", "sensor", t);
    const Motion reference = DifferencedMotion(pose_at, t, kStep);
    EXPECT_LT((motion.X.p - reference.X.p).norm(), kPosition);
    EXPECT_LT(motion.X.q.angularDistance(reference.X.q), kPosition);
    EXPECT_LT((motion.v - reference.v).norm(), kVelocity);
    EXPECT_LT((motion.omega - reference.omega).norm(), kVelocity);
    EXPECT_LT((motion.a - reference.a).norm(), kAcceleration);
    EXPECT_LT((motion.alpha - reference.alpha).norm(), kAcceleration);
  }
}

TEST(MotionTree, EvaluatesPartsOfTheChain) {
  MotionTree tree = MakeChain(1);
  tree.Finish();
  const Motion part = tree.Evaluate("body", "carrier", 0.5);
  const Pose expected = ArmInBody(0.5) * CarrierInArm(0.5);
  EXPECT_LT((part.X.p - expected.p).norm(), 1e-6);
  const Motion fixed = tree.Evaluate("carrier", "sensor", 17);
  EXPECT_LT((fixed.X.p - kSensorInCarrier.p).norm(), 1e-15);
  EXPECT_EQ(fixed.v.norm() + fixed.a.norm() + fixed.omega.norm() + fixed.alpha.norm(), 0);
  EXPECT_EQ(tree.Evaluate("arm", "arm", 0.5).X.p, Vector3d::Zero());
}

TEST(MotionTree, KnowsItsFrames) {
  const MotionTree tree = MakeChain(0.1);
  for (const char* frame : {"map", "body", "arm", "carrier", "sensor"}) {
    EXPECT_TRUE(tree.Has(frame));
    EXPECT_EQ(tree.RootOf(frame), "map");
    EXPECT_TRUE(tree.Connected("map", frame));
    EXPECT_TRUE(tree.Connected(frame, frame));
  }
  EXPECT_FALSE(tree.Has("wheel"));
  EXPECT_EQ(tree.RootOf("wheel"), "wheel");
  EXPECT_FALSE(tree.Connected("map", "wheel"));
  EXPECT_FALSE(tree.Connected("wheel", "map"));
  EXPECT_FALSE(tree.Connected("wheel", "wheel"));
  EXPECT_FALSE(tree.Connected("sensor", "map")) << "upwards only";
}

TEST(MotionTree, Times) {
  MotionTree tree = MakeChain(1);
  EXPECT_DOUBLE_EQ(tree.BeginTime("map", "sensor"), 0.05);
  EXPECT_DOUBLE_EQ(tree.BeginTime("arm", "sensor"), 0.0117);
  EXPECT_DOUBLE_EQ(tree.EndTime("map", "sensor"), 0.983);
  EXPECT_NEAR(tree.ReadyUntil("map", "sensor"), 0.983 - PoseCurve::kWindow / 50.0, 1e-12);
  tree.Finish();
  EXPECT_DOUBLE_EQ(tree.ReadyUntil("map", "sensor"), 0.983);
  EXPECT_EQ(tree.BeginTime("carrier", "sensor"), -kInfinity);
  EXPECT_EQ(tree.EndTime("carrier", "sensor"), kInfinity);
  EXPECT_EQ(tree.ReadyUntil("carrier", "sensor"), kInfinity);
  EXPECT_EQ(tree.BeginTime("map", "wheel"), kInfinity);
  EXPECT_EQ(tree.EndTime("map", "wheel"), -kInfinity);
  EXPECT_EQ(tree.ReadyUntil("map", "wheel"), -kInfinity);
}

TEST(MotionTree, ClearForgetsSamplesAndKeepsEdges) {
  MotionTree tree = MakeChain(1);
  tree.Finish();
  tree.Clear();
  EXPECT_TRUE(tree.Connected("map", "sensor"));
  EXPECT_EQ(tree.BeginTime("map", "sensor"), kInfinity);
  EXPECT_EQ(tree.EndTime("map", "sensor"), -kInfinity);
  EXPECT_EQ(tree.ReadyUntil("map", "sensor"), -kInfinity);
  EXPECT_LT((tree.Evaluate("carrier", "sensor", 0).X.p - kSensorInCarrier.p).norm(), 1e-15);
  EXPECT_TRUE(tree.Append("map", "body", 0.001, BodyInMap(0)))
      << "earlier than before, after Finish";
}

TEST(MotionTree, RefusesEdgesThatMakeNoTree) {
  MotionTree tree = MakeChain(0.1);
  EXPECT_FALSE(tree.Append("map", "arm", 1, Pose())) << "re-parenting";
  EXPECT_FALSE(tree.SetFixed("map", "sensor", Pose())) << "re-parenting";
  EXPECT_FALSE(tree.Append("carrier", "map", 1, Pose())) << "a loop";
  EXPECT_FALSE(tree.SetFixed("sensor", "map", Pose())) << "a loop";
  EXPECT_FALSE(tree.Append("map", "map", 1, Pose())) << "a loop";
  EXPECT_FALSE(tree.SetFixed("body", "arm", Pose())) << "it moves";
  EXPECT_FALSE(tree.Append("carrier", "sensor", 1, Pose())) << "it is fixed";
  EXPECT_FALSE(tree.Append("", "wheel", 1, Pose()));
  EXPECT_FALSE(tree.SetFixed("carrier", "", Pose()));
  Pose bad;
  bad.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(tree.SetFixed("carrier", "wheel", bad));
  EXPECT_FALSE(tree.Has("wheel"));
  EXPECT_FALSE(tree.Append("body", "arm", 1, bad));
  EXPECT_EQ(tree.ignored_count(), 1u);
  EXPECT_EQ(tree.RootOf("sensor"), "map");
  // A latched static transform comes again, corrected.
  EXPECT_TRUE(tree.SetFixed("carrier", "sensor", Pose()));
  EXPECT_EQ(tree.Evaluate("carrier", "sensor", 0).X.p, Vector3d::Zero());
}

TEST(MotionTree, CountsGapsOfAllEdges) {
  MotionTree tree(0.1);
  for (const double t : {0.0, 0.05, 0.3, 0.35}) tree.Append("map", "body", t, BodyInMap(t));
  for (const double t : {0.0, 0.05, 0.1, 0.5}) tree.Append("body", "arm", t, ArmInBody(t));
  EXPECT_EQ(tree.gap_count(), 2u);
  EXPECT_TRUE(tree.InGap("map", "arm", 0.2));
  EXPECT_TRUE(tree.InGap("map", "arm", 0.4));
  EXPECT_FALSE(tree.InGap("map", "body", 0.32));
  EXPECT_FALSE(tree.InGap("map", "arm", 0.02));
}

TEST(MotionTree, DropBeforeKeepsTheMotion) {
  MotionTree whole = MakeChain(1), trimmed = MakeChain(1);
  trimmed.DropBefore(0.6);
  EXPECT_GT(trimmed.BeginTime("map", "sensor"), 0.5);
  for (double t = 0.6; t < 0.78; t += 0.01) {
    EXPECT_EQ(whole.Evaluate("map", "sensor", t).a, trimmed.Evaluate("map", "sensor", t).a);
  }
}

TEST(MotionTree, FollowsAsItEvaluates) {
  // The chain is composed from the other end: roundings of accelerations of some 100 m/s^2.
  constexpr double kRounding = 1e-10;
  MotionTree tree = MakeChain(1);
  const auto expect_same = [&](const std::string& frame, double t) {
    const Motion followed = tree.Follow(tree.FindLink("map", frame), t),
                 evaluated = tree.Evaluate("map", frame, t);
    EXPECT_LT((followed.X.p - evaluated.X.p).norm(), kRounding) << frame << " at " << t;
    EXPECT_LT((followed.X.q.coeffs() - evaluated.X.q.coeffs()).norm(), kRounding);
    EXPECT_LT((followed.v - evaluated.v).norm(), kRounding);
    EXPECT_LT((followed.a - evaluated.a).norm(), kRounding);
    EXPECT_LT((followed.omega - evaluated.omega).norm(), kRounding);
    EXPECT_LT((followed.alpha - evaluated.alpha).norm(), kRounding);
  };
  // Forwards and backwards, past what is final, and at samples.
  for (const double t : {0.0, 0.3, 0.301, 0.302, 0.35, 0.21, 0.503, 0.9, 0.99, 0.9901, 1.5, 0.5}) {
    for (const char* frame : {"sensor", "body", "arm", "carrier", "map"}) expect_same(frame, t);
  }
  // What it remembers is of no use once samples are added or others take their place.
  expect_same("carrier", 0.99);
  tree.Append("arm", "carrier", 1.0, CarrierInArm(1.2));
  expect_same("carrier", 0.99);
  tree.Clear();
  for (const double t : {0.2, 0.4, 0.6}) {
    tree.Append("map", "body", t, BodyInMap(2 * t));
    tree.Append("body", "arm", t, ArmInBody(2 * t));
    tree.Append("arm", "carrier", t, CarrierInArm(2 * t));
  }
  expect_same("carrier", 0.5);
}

TEST(MotionTree, FollowIsIndependentOfItsPast) {
  MotionTree each = MakeChain(1), some = MakeChain(1);
  const MotionTree::Link of_each = each.FindLink("map", "sensor"),
                         of_some = some.FindLink("map", "sensor");
  for (double t = 0.3; t < 0.7; t += 0.001) each.Follow(of_each, t);
  for (const double t : {0.44, 0.5, 0.52, 0.6}) {
    EXPECT_EQ(each.Follow(of_each, t).a, some.Follow(of_some, t).a) << t;
    EXPECT_EQ(each.Follow(of_each, t).alpha, some.Follow(of_some, t).alpha) << t;
  }
}

TEST(MotionTree, ADetachedFrameMayHaveAnotherParent) {
  MotionTree tree = MakeChain(1);
  EXPECT_FALSE(tree.SetFixed("map", "arm", Pose()));
  tree.Detach("arm");
  tree.Detach("unheard of");
  EXPECT_FALSE(tree.Connected("map", "arm"));
  EXPECT_TRUE(tree.Connected("arm", "sensor"));
  const Pose X_MA = {{1, 2, 3}, Quaterniond::Identity()};
  EXPECT_TRUE(tree.SetFixed("map", "arm", X_MA));
  EXPECT_EQ(tree.Evaluate("map", "arm", 0.5).X.p, X_MA.p);
  // The other way round it was a loop before.
  tree.Detach("arm");
  EXPECT_TRUE(tree.SetFixed("arm", "map", X_MA));
  EXPECT_EQ(tree.Evaluate("arm", "map", 0.5).X.p, X_MA.p);
}

}  // namespace
}  // namespace cosserat_cable
