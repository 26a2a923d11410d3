#include <gtest/gtest.h>

#include <thread>

#include "contact/meshes.h"
#include "cosserat_cable/contact/body.h"

namespace cosserat_cable {
namespace {

using test::BoxMesh;
using test::BruteForceDistance;
using test::MakeBody;
using test::MakeShape;
using test::RandomPoints;
using test::SheetMesh;
using test::SomePose;
using test::SphereMesh;
using test::UrchinMesh;
using test::WindingNumber;

constexpr double kFar = std::numeric_limits<double>::infinity();
// Coordinates are about 1 m: a few hundred roundings of 1e-16.
constexpr double kRounding = 1e-13;
// A normal is a difference of points divided by a distance of at least 1e-3 m.
constexpr double kNormalRounding = 1e-10;

// Distance by brute force, sign by winding number; `nearest` and `normal` by what they mean.
void ExpectSignedDistance(const Body& body, const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  const Clearance clearance = body.Query(p, kFar);
  const double distance = BruteForceDistance(mesh, p);
  if (distance > kRounding) {
    const double sign = WindingNumber(mesh, p) > 0.5 ? -1 : 1;
    ASSERT_NEAR(clearance.distance, sign * distance, kRounding) << p.transpose();
  } else {
    ASSERT_NEAR(clearance.distance, 0, kRounding) << p.transpose();
  }
  ASSERT_NEAR((p - clearance.nearest).norm(), distance, kRounding) << p.transpose();
  ASSERT_NEAR(BruteForceDistance(mesh, clearance.nearest), 0, kRounding) << p.transpose();
  ASSERT_NEAR(clearance.normal.norm(), 1, kRounding);
  if (distance > 1e-3) {
    ASSERT_NEAR((p - clearance.nearest - clearance.distance * clearance.normal).norm(), 0,
                kNormalRounding);
  }
  ASSERT_FALSE(clearance.two_sided);
}

class ClosedMesh : public ::testing::TestWithParam<int> {
 protected:
  static TriangleMesh Mesh() {
    TriangleMesh mesh;
    switch (GetParam()) {
      case 0:
        mesh = BoxMesh({0.4, 0.3, 0.2});
        break;
      case 1:
        mesh = SphereMesh(0.3, 8, 12);
        break;
      default:
        mesh = UrchinMesh(0.3, 9, 13);
        break;
    }
    return test::Moved(mesh, test::SomePose());
  }
};

TEST_P(ClosedMesh, SignedDistanceAtRandomPoints) {
  const TriangleMesh mesh = Mesh();
  const Body body = MakeBody(mesh);
  RandomPoints random(11);
  for (int i = 0; i < 1000; ++i) {
    ExpectSignedDistance(body, mesh, test::SomePose().p + random.InCube(0.5));
  }
}

// Where signs go wrong: straight out from corners and edges, and a hair's breadth from them.
TEST_P(ClosedMesh, SignedDistanceAroundCornersAndEdges) {
  const TriangleMesh mesh = Mesh();
  const Body body = MakeBody(mesh);
  RandomPoints random(12);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d &a = mesh.vertices[t[k]], &b = mesh.vertices[t[(k + 1) % 3]];
      const Eigen::Vector3d middle = a + random.In(0, 1) * (b - a);
      for (double r : {1e-2, 1e-4, 1e-7}) {
        ExpectSignedDistance(body, mesh, a + r * random.Direction());
        ExpectSignedDistance(body, mesh, middle + r * random.Direction());
      }
    }
  }
}

TEST_P(ClosedMesh, OnTheSurfaceTheNormalPointsOut) {
  const TriangleMesh mesh = Mesh();
  const Body body = MakeBody(mesh);
  RandomPoints random(13);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                          &c = mesh.vertices[t[2]];
    const Eigen::Vector3d face_normal = (b - a).cross(c - a).normalized();
    const double u = random.In(0.1, 0.5), v = random.In(0.1, 0.4);
    const Eigen::Vector3d on_face = a + u * (b - a) + v * (c - a);
    for (double height : {0.0, 1e-17, -1e-17, 1e-14, -1e-14, 1e-8, -1e-8}) {
      const Clearance clearance = body.Query(on_face + height * face_normal, kFar);
      ASSERT_NEAR(clearance.distance, height, kRounding);
      ASSERT_NEAR((clearance.normal - face_normal).norm(), 0, kRounding);
    }
    // Exactly at a corner and on an edge: out of all faces' average, never NaN.
    for (const Eigen::Vector3d& p : {a, Eigen::Vector3d((a + b) / 2)}) {
      const Clearance clearance = body.Query(p, kFar);
      ASSERT_NEAR(clearance.distance, 0, kRounding);
      ASSERT_NEAR(clearance.normal.norm(), 1, kRounding);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ClosedMesh, ::testing::Values(0, 1, 2));

TEST(BodyMesh, AgreesWithTheSphereItApproximates) {
  const double radius = 0.3;
  const int rings = 60, sectors = 100;
  const Body body = MakeBody(SphereMesh(radius, rings, sectors));
  EXPECT_EQ(body.triangle_count(), 2 * sectors * (rings - 1));
  // A facet of edge h lies at most h^2 / (4 r) (two perpendicular edges' sagittas) within the
  // sphere.
  const double h = 2 * M_PI * radius / sectors;
  const double kSagitta = h * h / (4 * radius);
  RandomPoints random(14);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = random.InCube(0.5);
    const double distance = body.Query(p, kFar).distance;
    const double exact = p.norm() - radius;
    EXPECT_GE(distance, exact - kRounding);
    EXPECT_LE(distance, exact + kSagitta);
  }
}

TEST(BodyMesh, ExactBoxDistances) {
  const Body body = MakeBody(BoxMesh({0.2, 0.4, 0.6}));
  struct Case {
    Eigen::Vector3d p;
    double distance;
    Eigen::Vector3d normal;
  };
  const double r = std::sqrt(0.5), s = std::sqrt(1. / 3);
  for (const Case& c : {Case{{0.15, 0, 0}, 0.05, {1, 0, 0}}, Case{{0.09, 0, 0.1}, -0.01, {1, 0, 0}},
                        Case{{0.13, 0.23, 0}, std::sqrt(18e-4), {r, r, 0}},
                        Case{{-0.12, -0.22, -0.32}, std::sqrt(12e-4), {-s, -s, -s}},
                        Case{{0.1, 0.2, 0}, 0, {r, r, 0}}}) {
    const Clearance clearance = body.Query(c.p, kFar);
    EXPECT_NEAR(clearance.distance, c.distance, kRounding);
    EXPECT_NEAR((clearance.normal - c.normal).norm(), 0, kNormalRounding) << clearance.normal;
  }
}

TEST(BodyMesh, InwardFacingMeshIsTurned) {
  TriangleMesh mesh = BoxMesh({0.2, 0.2, 0.2});
  for (Eigen::Vector3i& t : mesh.triangles) std::swap(t[0], t[1]);
  const Clearance clearance = MakeBody(mesh).Query({0, 0, 0.09}, kFar);
  EXPECT_NEAR(clearance.distance, -0.01, kRounding);
  EXPECT_NEAR((clearance.normal - Eigen::Vector3d::UnitZ()).norm(), 0, kRounding);
}

TEST(BodyMesh, UnweldedTrianglesStillClose) {
  const TriangleMesh welded = BoxMesh({0.2, 0.2, 0.2});
  TriangleMesh soup;
  for (const Eigen::Vector3i& t : welded.triangles) {
    for (int i : t) soup.vertices.push_back(welded.vertices[i]);
    const int n = static_cast<int>(soup.vertices.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  const Clearance clearance = MakeBody(soup).Query({0, 0, 0.09}, kFar);
  EXPECT_FALSE(clearance.two_sided);
  EXPECT_NEAR(clearance.distance, -0.01, kRounding);
}

// A corner in the middle of another triangle's edge, bridged by a triangle without area, as CAD
// exports have it.
TEST(BodyMesh, SliverWithoutAreaLeavesTheMeshClosed) {
  TriangleMesh mesh = BoxMesh({0.2, 0.2, 0.2});
  const int middle = static_cast<int>(mesh.vertices.size());
  const Eigen::Vector3i top = mesh.triangles[2];  // 4, 5, 7
  mesh.vertices.push_back((mesh.vertices[top[0]] + mesh.vertices[top[1]]) / 2);
  mesh.triangles[2] = {top[0], middle, top[2]};
  mesh.triangles.push_back({middle, top[1], top[2]});
  mesh.triangles.push_back({top[0], top[1], middle});  // no height
  const Body body = MakeBody(mesh);
  EXPECT_EQ(body.triangle_count(), 14);
  RandomPoints random(15);
  const TriangleMesh plain = BoxMesh({0.2, 0.2, 0.2});
  for (int i = 0; i < 500; ++i) ExpectSignedDistance(body, plain, random.InCube(0.15));
}

TEST(BodyMesh, OpenMeshIsATwoSidedShell) {
  const TriangleMesh mesh = SheetMesh(0.2, 0.2, 4);
  const Body body = MakeBody(mesh);
  for (double side : {1.0, -1.0}) {
    const Clearance clearance = body.Query({0.03, 0.02, side * 0.004}, kFar);
    EXPECT_TRUE(clearance.two_sided);
    EXPECT_FALSE(clearance.rim);
    EXPECT_NEAR(clearance.distance, 0.004, kRounding);
    EXPECT_NEAR((clearance.normal - side * Eigen::Vector3d::UnitZ()).norm(), 0, kRounding);
  }
  const Clearance beyond = body.Query({0.103, 0, 0.004}, kFar);
  EXPECT_TRUE(beyond.rim);
  EXPECT_NEAR(beyond.distance, 0.005, kRounding);
  EXPECT_NEAR((beyond.normal - Eigen::Vector3d(0.6, 0, 0.8)).norm(), 0, kNormalRounding);
  const Clearance on_rim = body.Query({0.1, 0.01, 0}, kFar);
  EXPECT_TRUE(on_rim.rim);
  EXPECT_NEAR(on_rim.distance, 0, kRounding);
  EXPECT_NEAR(on_rim.normal.norm(), 1, kRounding);

  RandomPoints random(16);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = random.InCube(0.2);
    const Clearance clearance = body.Query(p, kFar);
    ASSERT_NEAR(clearance.distance, BruteForceDistance(mesh, p), kRounding);
    ASSERT_GE((p - clearance.nearest).dot(clearance.normal), -kRounding);
  }
}

// Twice the same sheet, back to back: every edge is matched, but there is no inside.
TEST(BodyMesh, SheetDrawnTwiceIsAShell) {
  TriangleMesh mesh = SheetMesh(0.2, 0.2, 2);
  TriangleMesh back = mesh;
  for (Eigen::Vector3i& t : back.triangles) std::swap(t[0], t[1]);
  const Body body = MakeBody(test::Joined(mesh, back));
  for (double side : {1.0, -1.0}) {
    const Clearance clearance = body.Query({0.03, 0.02, side * 0.004}, kFar);
    EXPECT_TRUE(clearance.two_sided);
    EXPECT_NEAR(clearance.distance, 0.004, kRounding);
    EXPECT_NEAR((clearance.normal - side * Eigen::Vector3d::UnitZ()).norm(), 0, kRounding);
  }
  EXPECT_TRUE(body.Query({0.103, 0, 0.004}, kFar).rim);
}

TEST(BodyMesh, ClosedAndOpenPartsOfOneFileEachCountAsWhatTheyAre) {
  const TriangleMesh mesh = test::Joined(
      BoxMesh({0.1, 0.1, 0.1}), test::Moved(SheetMesh(0.1, 0.1, 2), {{0.2, 0, 0}, {1, 0, 0, 0}}));
  const Body body = MakeBody(mesh);
  const Clearance in_box = body.Query({0, 0, 0.04}, kFar);
  EXPECT_FALSE(in_box.two_sided);
  EXPECT_NEAR(in_box.distance, -0.01, kRounding);
  const Clearance under_sheet = body.Query({0.2, 0, -0.01}, kFar);
  EXPECT_TRUE(under_sheet.two_sided);
  EXPECT_NEAR(under_sheet.distance, 0.01, kRounding);
}

TEST(BodyMesh, OverlappingClosedPartsAreOneUnion) {
  const TriangleMesh a = BoxMesh({0.2, 0.2, 0.2});
  const TriangleMesh b = test::Moved(BoxMesh({0.2, 0.2, 0.2}), {{0.1, 0.03, 0.02}, {1, 0, 0, 0}});
  const Body body = MakeBody(test::Joined(a, b));
  RandomPoints random(17);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = random.InCube(0.25);
    double expected = kFar;
    for (const TriangleMesh* part : {&a, &b}) {
      const double sign = WindingNumber(*part, p) > 0.5 ? -1 : 1;
      expected = std::min(expected, sign * BruteForceDistance(*part, p));
    }
    ASSERT_NEAR(body.Query(p, kFar).distance, expected, kRounding);
  }
}

TEST(BodyMesh, ReachPrunesOnlyWhatIsFartherAndNeverTheInside) {
  const TriangleMesh mesh = test::Moved(UrchinMesh(0.3, 9, 13), test::SomePose());
  const Body body = MakeBody(mesh);
  RandomPoints random(18);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = test::SomePose().p + random.InCube(0.6);
    const double reach = random.In(0.01, 0.2);
    const Clearance full = body.Query(p, kFar);
    const Clearance pruned = body.Query(p, reach);
    if (full.distance < reach) {
      ASSERT_EQ(pruned.distance, full.distance);
      ASSERT_EQ(pruned.nearest, full.nearest);
    } else {
      ASSERT_EQ(pruned.distance, kFar);
      ASSERT_EQ(pruned.shape, -1);
    }
    ASSERT_LE(body.LowerBound(p), full.distance + kRounding);
  }
}

TEST(BodyMesh, PoseOfAShapeMovesItsAnswers) {
  const TriangleMesh mesh = UrchinMesh(0.3, 9, 13);
  const Body body = MakeBody(mesh, test::SomePose());
  RandomPoints random(19);
  for (int i = 0; i < 500; ++i) {
    ExpectSignedDistance(body, test::Moved(mesh, test::SomePose()),
                         test::SomePose().p + random.InCube(0.5));
  }
}

TEST(BodyMesh, NonFiniteQueriesAreInfinitelyFar) {
  const Body body = MakeBody(BoxMesh({1, 1, 1}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double bad : {nan, kFar, -kFar}) {
    EXPECT_EQ(body.Query({0, bad, 0}, 1.0).distance, kFar);
    EXPECT_EQ(body.Query({0, bad, 0}, 1.0).shape, -1);
    EXPECT_EQ(body.LowerBound({bad, 0, 0}), kFar);
  }
  EXPECT_EQ(body.Query({1e300, 0, 0}, 1.0).distance, kFar);
}

TEST(BodyMesh, InvalidMeshesAreRefused) {
  TriangleMesh mesh = BoxMesh({1, 1, 1});
  mesh.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MakeBody(mesh), std::invalid_argument);
  mesh = BoxMesh({1, 1, 1});
  mesh.triangles[0][1] = 8;
  EXPECT_THROW(MakeBody(mesh), std::invalid_argument);
}

TEST(BodyMesh, EmptyBodyIsInfinitelyFar) {
  const Body body(std::vector<Shape>{});
  EXPECT_EQ(body.Query({0, 0, 0}, kFar).distance, kFar);
  EXPECT_EQ(body.LowerBound({0, 0, 0}), kFar);
  EXPECT_TRUE(body.bounds().isEmpty());
  EXPECT_EQ(body.triangle_count(), 0);
}

// A square ring about y, as a wheel lies in its frame: outer half width 0.3, inner 0.2, along y
// from -0.05 to 0.05 [m].
TriangleMesh SquareRing() {
  TriangleMesh ring;
  for (const double half : {0.3, 0.2}) {
    for (const double y : {-0.05, 0.05}) {
      for (int i = 0; i < 4; ++i) {
        ring.vertices.push_back({i == 0 || i == 3 ? half : -half, y, i < 2 ? half : -half});
      }
    }
  }
  const auto add_side = [&](int from, int to) {
    for (int i = 0; i < 4; ++i) {
      const int j = (i + 1) % 4;
      ring.triangles.push_back({from + i, from + j, to + j});
      ring.triangles.push_back({from + i, to + j, to + i});
    }
  };
  add_side(0, 4);   // outside
  add_side(12, 8);  // inside
  add_side(8, 0);   // at either end
  add_side(4, 12);
  return ring;
}

TEST(BodyMesh, LowerBoundKnowsTheHoleOfAWheel) {
  const TriangleMesh ring = SquareRing();
  const Body body = MakeBody(ring, SomePose());
  const Body centred = MakeBody(ring);
  RandomPoints random(21);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = random.InCube(0.6);
    EXPECT_LE(centred.LowerBound(p), BruteForceDistance(ring, p) + kRounding);
    EXPECT_LE(body.LowerBound(SomePose() * p), BruteForceDistance(ring, p) + kRounding);
  }
  // Beside the ring, never less than from the circle of its corners; in its hole, about y, turning
  // changes nothing.
  for (double angle = 0; angle < 2 * M_PI; angle += 0.1) {
    const Eigen::Vector3d around(std::cos(angle), 0, std::sin(angle));
    EXPECT_GE(centred.LowerBound(0.5 * around), 0.5 - 0.3 * std::sqrt(2) - kRounding);
    EXPECT_NEAR(centred.LowerBound(0.05 * around), 0.15, kRounding);
  }
}

TEST(BodyMesh, BodiesOfOneStoreAnswerAsIfAlone) {
  const TriangleMesh mesh = UrchinMesh(0.3, 9, 13);
  MeshStore store;
  const Body first(std::vector<Shape>{MakeShape({}, mesh)}, &store);
  const std::vector<Shape> shapes = {MakeShape(SomePose(), mesh),
                                     MakeShape({}, BoxMesh({0.9, 0.1, 0.1}))};
  const Body second(shapes, &store);
  const Body alone(shapes);
  EXPECT_EQ(second.triangle_count(), alone.triangle_count());
  RandomPoints random(22);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = random.InCube(0.6);
    const Clearance got = second.Query(p, kFar), expected = alone.Query(p, kFar);
    EXPECT_EQ(got.distance, expected.distance);
    EXPECT_EQ(got.nearest, expected.nearest);
    EXPECT_EQ(got.normal, expected.normal);
    EXPECT_EQ(got.shape, expected.shape);
    EXPECT_EQ(first.Query(p, kFar).shape, 0);
  }
}

TEST(BodyMesh, ThreadsGetTheSameAnswers) {
  const Body body = MakeBody(UrchinMesh(0.3, 20, 31));
  const auto sum = [&] {
    RandomPoints random(20);
    double total = 0;
    for (int i = 0; i < 3000; ++i) total += body.Query(random.InCube(0.5), kFar).distance;
    return total;
  };
  const double expected = sum();
  double got[2] = {0, 0};
  std::thread first([&] { got[0] = sum(); }), second([&] { got[1] = sum(); });
  first.join();
  second.join();
  EXPECT_EQ(got[0], expected);
  EXPECT_EQ(got[1], expected);
}

}  // namespace
}  // namespace cosserat_cable
