#include <gtest/gtest.h>

#include "contact/meshes.h"
#include "cosserat_cable/contact/body.h"

namespace cosserat_cable {
namespace {

using test::MakeBody;
using test::RandomPoints;

constexpr double kFar = std::numeric_limits<double>::infinity();
// Coordinates are about 1 m: a few hundred roundings of 1e-16.
constexpr double kRounding = 1e-13;
// Central differences over 1e-6 m of a function with |second derivative| below 1e4 / m, plus
// rounding.
constexpr double kGradientError = 1e-5;

// The gradient of a signed distance is the normal; that also links distance, nearest and normal.
void ExpectConsistent(const Body& body, const Eigen::Vector3d& p) {
  const Clearance at = body.Query(p, kFar);
  ASSERT_NEAR(at.normal.norm(), 1, kRounding);
  ASSERT_NEAR((p - at.nearest - at.distance * at.normal).norm(), 0, kRounding) << p.transpose();
  ASSERT_NEAR(body.Query(at.nearest, kFar).distance, 0, kRounding);
  ASSERT_LE(body.LowerBound(p), at.distance + kRounding);
}

TEST(BodyPrimitive, Sphere) {
  const Pose X = test::SomePose();
  const Body body = MakeBody(Sphere{0.2}, X);
  RandomPoints random(1);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = X.p + random.InCube(0.5);
    ASSERT_NEAR(body.Query(p, kFar).distance, (p - X.p).norm() - 0.2, kRounding);
    ExpectConsistent(body, p);
  }
  EXPECT_NEAR(body.Query(X.p, kFar).distance, -0.2, kRounding);
  EXPECT_NEAR(body.Query(X.p, kFar).normal.norm(), 1, kRounding);
}

// A box of triangles is the reference for a box.
TEST(BodyPrimitive, BoxAgreesWithItsMesh) {
  const Pose X = test::SomePose();
  const Eigen::Vector3d size(0.2, 0.3, 0.5);
  const Body body = MakeBody(Box{size}, X);
  const TriangleMesh mesh = test::Moved(test::BoxMesh(size), X);
  RandomPoints random(2);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = X.p + random.InCube(0.5);
    const double sign = test::WindingNumber(mesh, p) > 0.5 ? -1 : 1;
    ASSERT_NEAR(body.Query(p, kFar).distance, sign * test::BruteForceDistance(mesh, p), kRounding);
    ExpectConsistent(body, p);
  }
}

TEST(BodyPrimitive, CylinderAtPointsKnownByHand) {
  const Body body = MakeBody(Cylinder{0.1, 0.4});
  struct Case {
    Eigen::Vector3d p;
    double distance;
    Eigen::Vector3d normal;
  };
  for (const Case& c :
       {Case{{0.15, 0, 0.1}, 0.05, {1, 0, 0}}, Case{{0, -0.15, 0}, 0.05, {0, -1, 0}},
        Case{{0.05, 0, 0.25}, 0.05, {0, 0, 1}}, Case{{0, 0, -0.3}, 0.1, {0, 0, -1}},
        Case{{0.13, 0, 0.24}, 0.05, {0.6, 0, 0.8}}, Case{{0, 0.13, -0.24}, 0.05, {0, 0.6, -0.8}},
        Case{{0.09, 0, 0}, -0.01, {1, 0, 0}}, Case{{0, 0.05, 0.19}, -0.01, {0, 0, 1}}}) {
    const Clearance clearance = body.Query(c.p, kFar);
    EXPECT_NEAR(clearance.distance, c.distance, kRounding) << c.p.transpose();
    EXPECT_NEAR((clearance.normal - c.normal).norm(), 0, kRounding) << c.p.transpose();
  }
  EXPECT_NEAR(body.Query({0, 0, 0}, kFar).distance, -0.1, kRounding);
}

TEST(BodyPrimitive, CylinderNormalIsTheGradient) {
  const Pose X = test::SomePose();
  const Body body = MakeBody(Cylinder{0.1, 0.4}, X);
  RandomPoints random(3);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = X.p + random.InCube(0.4);
    ExpectConsistent(body, p);
    const Clearance at = body.Query(p, kFar);
    if (at.distance < 1e-3) continue;  // inside, the gradient jumps between the faces
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(k);
      const double slope =
          (body.Query(p + step, kFar).distance - body.Query(p - step, kFar).distance) / 2e-6;
      ASSERT_NEAR(slope, at.normal[k], kGradientError);
    }
  }
}

TEST(BodyPrimitive, NormalsOnTheSurfaceItself) {
  const Body box = MakeBody(Box{{0.2, 0.2, 0.2}});
  EXPECT_NEAR((box.Query({0.1, 0, 0}, kFar).normal - Eigen::Vector3d::UnitX()).norm(), 0,
              kRounding);
  EXPECT_NEAR(box.Query({0.1, 0.1, 0.1}, kFar).distance, 0, kRounding);
  EXPECT_NEAR(box.Query({0.1, 0.1, 0.1}, kFar).normal.norm(), 1, kRounding);
  // Beyond an edge by less than a direction can be told from rounding.
  const Clearance edge = box.Query({0.1 + 1e-13, 0.1 + 1e-14, 0}, kFar);
  EXPECT_NEAR((edge.normal - Eigen::Vector3d(1, 1, 0).normalized()).norm(), 0, kRounding);
  const Body cylinder = MakeBody(Cylinder{0.1, 0.4});
  EXPECT_NEAR((cylinder.Query({0, 0.1, 0}, kFar).normal - Eigen::Vector3d::UnitY()).norm(), 0,
              kRounding);
}

TEST(BodyPrimitive, TheNearestShapeWinsAndIsNamed) {
  std::vector<Shape> shapes(3);
  shapes[0].geometry = Sphere{0.1};
  shapes[1].X_LS.p = {0.5, 0, 0};
  shapes[1].geometry = Box{{0.2, 0.2, 0.2}};
  shapes[2].X_LS.p = {1, 0, 0};
  shapes[2].geometry = test::SheetMesh(0.2, 0.2, 1);
  const Body body(shapes);
  EXPECT_EQ(body.Query({0.2, 0, 0}, kFar).shape, 0);
  EXPECT_EQ(body.Query({0.3, 0, 0}, kFar).shape, 1);
  EXPECT_EQ(body.Query({1, 0, 0.1}, kFar).shape, 2);
  EXPECT_TRUE(body.Query({1, 0, 0.1}, kFar).two_sided);
  EXPECT_EQ(body.Query({0.25, 0, 0}, 0.1).distance, kFar);
  EXPECT_NEAR(body.bounds().min().x(), -0.1, kRounding);
  EXPECT_NEAR(body.bounds().max().x(), 1.1, kRounding);
}

TEST(BodyPrimitive, SizesMustBePositive) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MakeBody(Sphere{0}), std::invalid_argument);
  EXPECT_THROW(MakeBody(Box{{1, -1, 1}}), std::invalid_argument);
  EXPECT_THROW(MakeBody(Cylinder{1, nan}), std::invalid_argument);
}

}  // namespace
}  // namespace cosserat_cable
