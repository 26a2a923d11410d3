// What FCL 0.7 may be trusted with. Body takes only FCL's tree of boxes from it, and walks it
// itself; these tests say why, and would tell if a newer FCL were different: a row that fails here
// is a row to think over again.
#include <fcl/fcl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "contact/meshes.h"
#include "cosserat_cable/contact/body.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;
using Mesh = fcl::BVHModel<fcl::OBBRSSd>;

// Exact: coordinates below 1 m, some roundings of 1e-16.
constexpr double kExact = 2e-15;
// An error that no rounding explains.
constexpr double kInexact = 1e-9;
constexpr double kFar = std::numeric_limits<double>::infinity();
const double kNan = std::numeric_limits<double>::quiet_NaN();
const fcl::DistanceRequestd kUnsigned(true);

std::unique_ptr<Mesh> Build(const TriangleMesh& mesh) {
  auto model = std::make_unique<Mesh>();
  std::vector<fcl::Triangle> triangles;
  for (const Eigen::Vector3i& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  model->beginModel();
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

fcl::Transform3d ToFcl(const Pose& X) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() = X.q.toRotationMatrix();
  transform.translation() = X.p;
  return transform;
}

fcl::Transform3d At(double x, double y, double z) { return ToFcl({{x, y, z}, {1, 0, 0, 0}}); }

fcl::DistanceResultd Distance(const fcl::CollisionGeometryd& a, const fcl::Transform3d& X_a,
                              const fcl::CollisionGeometryd& b, const fcl::Transform3d& X_b,
                              const fcl::DistanceRequestd& request = kUnsigned) {
  fcl::DistanceResultd result;
  fcl::distance(&a, X_a, &b, X_b, request, result);
  return result;
}

Pose RandomPose(test::RandomPoints* random, double half) {
  Pose X;
  X.p = random->InCube(half);
  X.q = Eigen::Quaterniond(Eigen::AngleAxisd(random->In(-3, 3), random->Direction()));
  return X;
}

// Ternary search: the distance to a convex body is convex along a segment, and so to another
// segment.
template <typename DistanceAt>
double LeastAlong(const Vector3d& a, const Vector3d& b, DistanceAt distance_at) {
  double low = 0, high = 1;
  for (int i = 0; i < 100; ++i) {
    const double u = low + (high - low) / 3, v = high - (high - low) / 3;
    if (distance_at(a + u * (b - a)) < distance_at(a + v * (b - a))) {
      high = v;
    } else {
      low = u;
    }
  }
  return distance_at(a + low * (b - a));
}

TEST(FclTrust, PointAgainstMeshIsExactAndNearestPointsAreInTheMeshsFrame) {
  const TriangleMesh mesh = test::SphereMesh(0.3, 12, 16);
  const auto model = Build(mesh);
  const Pose X_WM = test::SomePose();
  const fcl::Sphered point(0);
  test::RandomPoints random(1);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p_W = X_WM.p + random.InCube(0.6);
    const Vector3d p_M = X_WM.Inverse() * p_W;
    const double exact = test::BruteForceDistance(mesh, p_M);
    const auto result = Distance(*model, ToFcl(X_WM), point, ToFcl({p_W, {1, 0, 0, 0}}));
    ASSERT_NEAR(result.min_distance, exact, kExact);
    // Documented as "in world coordinates"; they are not.
    ASSERT_NEAR((result.nearest_points[0] - p_M).norm(), exact, kExact);
    ASSERT_NEAR(test::BruteForceDistance(mesh, result.nearest_points[0]), 0, kExact);
  }
}

// The leaf returns without setting the distance that its caller goes on to use. For a point that is
// so exactly on a triangle: one reason why Body walks the tree itself.
TEST(FclTrust, SphereOverlappingATriangleLeavesTheDistanceUnset) {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  constexpr double kUnset = 123;
  for (double radius : {0.1, 0.0}) {
    double distance = kUnset;
    Vector3d on_sphere, on_triangle;
    const bool apart = fcl::detail::sphereTriangleDistance<double>(
        fcl::Sphered(radius), At(0.25, 0.25, 0), a, b, c, &distance, &on_sphere, &on_triangle);
    EXPECT_FALSE(apart);
    EXPECT_EQ(distance, kUnset);
  }
  TriangleMesh mesh;
  mesh.vertices = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(test::MakeBody(mesh).Query({0.25, 0.25, 0}, kFar).distance, 0);
}

TEST(FclTrust, CapsuleAgainstMeshIsInexactAndHasNoDepth) {
  const TriangleMesh mesh = test::SphereMesh(0.3, 12, 16);
  const auto model = Build(mesh);
  const double radius = 0.005, length = 0.05;
  const fcl::Capsuled capsule(radius, length);
  test::RandomPoints random(2);
  double worst = 0;
  for (int i = 0; i < 30; ++i) {
    Pose X = RandomPose(&random, 0.1);
    X.p += 0.5 * random.Direction();
    const double exact =
        LeastAlong(X * Vector3d(0, 0, -length / 2), X * Vector3d(0, 0, length / 2),
                   [&](const Vector3d& p) { return test::BruteForceDistance(mesh, p); }) -
        radius;
    const double distance = Distance(*model, At(0, 0, 0), capsule, ToFcl(X)).min_distance;
    worst = std::max(worst, std::abs(distance - exact));
  }
  EXPECT_GT(worst, kInexact);
  EXPECT_LT(worst, 1e-3);
  for (double x : {0.3, 0.28, 0.2}) {
    EXPECT_EQ(Distance(*model, At(0, 0, 0), fcl::Capsuled(0.05, 0.3), At(x, 0, 0)).min_distance,
              -1);
  }
}

struct TwoCapsules {
  Pose X_A, X_B;
  double exact;
};
const fcl::Capsuled kCapsuleA(0.02, 0.1), kCapsuleB(0.03, 0.2);

TwoCapsules RandomCapsules(test::RandomPoints* random) {
  TwoCapsules two{RandomPose(random, 0.1), RandomPose(random, 0.1), 0};
  const Vector3d b0 = two.X_B * Vector3d(0, 0, -0.1), b1 = two.X_B * Vector3d(0, 0, 0.1);
  two.exact = LeastAlong(two.X_A * Vector3d(0, 0, -0.05), two.X_A * Vector3d(0, 0, 0.05),
                         [&](const Vector3d& p) { return test::DistanceToSegment(p, b0, b1); }) -
              0.05;
  return two;
}

TEST(FclTrust, CapsuleAgainstCapsuleUnsignedIsExactWithDepth) {
  // Where the minimum is flat, a search along a segment finds it to the root of rounding squared.
  constexpr double kSearch = 1e-12;
  test::RandomPoints random(3);
  int overlapping = 0;
  for (int i = 0; i < 500; ++i) {
    const TwoCapsules two = RandomCapsules(&random);
    if (two.exact < 0) ++overlapping;
    ASSERT_NEAR(Distance(kCapsuleA, ToFcl(two.X_A), kCapsuleB, ToFcl(two.X_B)).min_distance,
                two.exact, kSearch);
  }
  EXPECT_GT(overlapping, 50);
}

TEST(FclTrust, CapsuleAgainstCapsuleSignedIsInexact) {
  const fcl::DistanceRequestd with_sign(true, true);
  test::RandomPoints random(3);
  double worst = 0;
  for (int i = 0; i < 50; ++i) {
    const TwoCapsules two = RandomCapsules(&random);
    const double distance =
        Distance(kCapsuleA, ToFcl(two.X_A), kCapsuleB, ToFcl(two.X_B), with_sign).min_distance;
    worst = std::max(worst, std::abs(distance - two.exact));
  }
  EXPECT_GT(worst, kInexact);
}

bool AbortedHungOrWrong(int status) { return !WIFEXITED(status) || WEXITSTATUS(status) != 0; }

// Runs `compute` in a child of its own; it has a second for what takes a microsecond.
template <typename Compute>
void ExpectAbortHangOrOtherThan(double right, Compute compute) {
  GTEST_FLAG_SET(death_test_style, "fast");
  EXPECT_EXIT(
      {
        alarm(1);
        _exit(std::abs(compute() - right) < kInexact ? 0 : 1);
      },
      AbortedHungOrWrong, "");
}

// Two capsules on one axis, 5 cm into each other: no answer at all.
TEST(FclTrustDeathTest, CapsuleAgainstCapsuleSignedMayNotReturn) {
  ExpectAbortHangOrOtherThan(-0.05, [] {
    return Distance(kCapsuleA, At(0, 0, 0), kCapsuleB, At(0, 0, 0.15),
                    fcl::DistanceRequestd(true, true))
        .min_distance;
  });
}

TEST(FclTrust, BoxAndMeshAgainstMeshAreExactApartAndBlindWhenCrossing) {
  const Vector3d size(0.1, 0.2, 0.3);
  const fcl::Boxd box(size);
  const auto box_mesh = Build(test::BoxMesh(size));
  for (double gap : {0.05, 0.1, 0.4}) {
    EXPECT_NEAR(Distance(*box_mesh, At(0, 0, 0), box, At(0.1 + gap, 0.03, 0.01)).min_distance, gap,
                kExact);
    EXPECT_NEAR(Distance(*box_mesh, At(0, 0, 0), *box_mesh, At(0.1 + gap, 0.03, 0.01)).min_distance,
                gap, kExact);
  }
  // Crossing by 1 to 5 cm: no depth, only a sign that they do.
  for (double x : {0.09, 0.05}) {
    EXPECT_EQ(Distance(*box_mesh, At(0, 0, 0), *box_mesh, At(x, 0.03, 0.01)).min_distance, 0);
    EXPECT_EQ(Distance(*box_mesh, At(0, 0, 0), box, At(x, 0.03, 0.01)).min_distance, -1);
  }
  // Wholly inside, they count as apart.
  const auto around = Build(test::BoxMesh({1, 1, 1}));
  EXPECT_NEAR(Distance(*around, At(0, 0, 0), *box_mesh, At(0, 0, 0)).min_distance, 0.35, kExact);
}

TEST(FclTrust, CollideHasNegativeDepthsAndDoesNotSeeTheInside) {
  const auto model = Build(test::BoxMesh({1, 1, 1}));
  const fcl::Sphered sphere(0.05);
  const fcl::CollisionRequestd request(10, true);
  fcl::CollisionResultd inside, across;
  fcl::collide(model.get(), At(0, 0, 0), &sphere, At(0.3, 0.1, 0.05), request, inside);
  EXPECT_EQ(inside.numContacts(), 0u);
  fcl::collide(model.get(), At(0, 0, 0), &sphere, At(0.52, 0.1, 0.05), request, across);
  ASSERT_GT(across.numContacts(), 0u);
  EXPECT_LT(across.getContact(0).penetration_depth, 0);

  EXPECT_NEAR(test::MakeBody(test::BoxMesh({1, 1, 1})).Query({0.3, 0.1, 0.05}, 0.05).distance, -0.2,
              kExact);
}

TEST(FclTrust, NanPosesAndTrianglesWithoutAreaGiveAWrongZero) {
  const fcl::Sphered point(0);
  const auto good = Build(test::BoxMesh({1, 1, 1}));
  EXPECT_EQ(Distance(*good, At(0, 0, 0), point, At(kNan, 0, 0)).min_distance, 0);
  EXPECT_EQ(Distance(*good, At(0, 0, 0), *good, At(kNan, 0, 0)).min_distance, 0);
  TriangleMesh mesh;
  mesh.triangles = {{0, 1, 2}};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(Distance(*Build(mesh), At(0, 0, 0), point, At(1, 0, 0.5)).min_distance, 0);
  EXPECT_EQ(test::MakeBody(mesh).Query({1, 0, 0.5}, kFar).distance, kFar) << "dropped, not guessed";
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, kNan, 0}};
  EXPECT_EQ(Distance(*Build(mesh), At(0, 0, 0), point, At(1, 0, 0.5)).min_distance, 0);
  EXPECT_THROW(test::MakeBody(mesh), std::invalid_argument);
}

TEST(FclTrustDeathTest, ANanPoseMayAbort) {
  const auto model = Build(test::SphereMesh(0.3, 12, 16));
  const fcl::Boxd box(0.1, 0.2, 0.3);
  ExpectAbortHangOrOtherThan(
      kFar, [&] { return Distance(*model, At(0, 0, 0), box, At(kNan, 0, 0)).min_distance; });
}

}  // namespace
}  // namespace cosserat_cable
