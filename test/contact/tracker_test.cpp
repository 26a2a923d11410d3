#include "cosserat_cable/contact/tracker.h"

#include <gtest/gtest.h>

#include "contact/meshes.h"
#include "cosserat_cable/contact/contact_law.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;
using test::MakeBody;

constexpr double kStep = 1e-3;      // [s]
constexpr double kRadius = 2.5e-3;  // [m], the thinner of the cables that the car has
constexpr double kMargin = 1e-3;
constexpr double kReach = 0.05;
// Coordinates are below 1 m.
constexpr double kRounding = 1e-12;

// Within 0.1 um of the surface a direction is told from two points with 1e-17 m of rounding each.
constexpr double kDirection = 1e-9;

TrackedClearance Track(ContactTracker* tracker, const Body& body, const Vector3d& p) {
  const TrackedClearance seen = tracker->Look(body, p, kRadius, kMargin, kReach);
  tracker->Accept(p, seen);
  return seen;
}

struct Mass {
  double mass;
  Vector3d p, v;
};

struct Flight {
  double deepest = std::numeric_limits<double>::infinity();  // smallest distance of the centre
  bool crossed = false;
};

// Semi-implicit Euler: crude, as a penalty at such a step is, but it neither gains nor loses a
// wall.
Flight Fly(const Body& body, const ContactLaw& law, int steps, Mass* mass) {
  ContactTracker tracker;
  Flight flight;
  Track(&tracker, body, mass->p);
  for (int i = 0; i < steps; ++i) {
    const TrackedClearance seen = tracker.Look(body, mass->p, kRadius, kMargin, kReach);
    tracker.Accept(mass->p, seen);
    flight.deepest = std::min(flight.deepest, seen.distance);
    flight.crossed = flight.crossed || seen.crossed;
    if (seen.exact) {
      const double rate = -mass->v.dot(seen.normal);
      const double force = law.Evaluate(kRadius - seen.distance, rate).value;
      mass->v += kStep * force / mass->mass * seen.normal;
    }
    mass->p += kStep * mass->v;
  }
  return flight;
}

const ContactLaw kLaw{2e4, 1e-4, 0.1};
// What 5 mm of a 0.2 kg/m cable weigh: it is stopped within half a millimetre.
constexpr double kLight = 1e-3;
// So heavy that its centre sinks in by v sqrt(m / k) = 4 mm: past a sheet, or the middle of a thin
// plate.
constexpr double kHeavy = 0.08;
constexpr double kSpeed = 2.0;  // [m/s]

struct Wall {
  const char* name;
  TriangleMesh mesh;
  double top;  // height of the surface that the mass comes from [m]
};

class Tunnelling : public ::testing::TestWithParam<int> {
 protected:
  static Wall GetWall() {
    switch (GetParam()) {
      case 0:
        return {"single-sided sheet", test::SheetMesh(0.2, 0.2, 5), 0};
      case 1:
        return {"closed box", test::BoxMesh({0.2, 0.2, 0.1}), 0.05};
      case 2:
        return {"closed plate of 2 mm", test::BoxMesh({0.2, 0.2, 0.002}), 0.001};
      default:
        return {"closed plate of 0.2 mm", test::BoxMesh({0.2, 0.2, 2e-4}), 1e-4};
    }
  }
};

TEST_P(Tunnelling, StoppedAtTwoMetresPerSecondWhereverTheStepFalls) {
  const Wall wall = GetWall();
  SCOPED_TRACE(wall.name);
  const Body body = MakeBody(wall.mesh);
  for (double mass : {kLight, kHeavy}) {
    // The step's phase against the surface, the side, and straight or slanting, over corners and
    // edges.
    for (double phase = 0; phase < 1; phase += 0.1) {
      for (double side : {1.0, -1.0}) {
        for (double slide : {0.0, 0.7}) {
          Mass m{mass,
                 {-0.02, 0, side * (wall.top + 0.02 + phase * kSpeed * kStep)},
                 {slide, 0, -side * kSpeed}};
          const Flight flight = Fly(body, kLaw, 60, &m);
          EXPECT_GT(side * m.p.z(), wall.top + kRadius) << "mass " << mass << " phase " << phase;
          EXPECT_GT(side * m.v.z(), 0);
          // Frictionless: nothing along the wall.
          EXPECT_NEAR(m.v.x(), slide, kDirection);
          EXPECT_LT(flight.deepest, kRadius);
          if (mass == kLight) {
            EXPECT_GT(flight.deepest, 0);
          } else {
            EXPECT_LT(flight.deepest, -1.05e-3) << "should reach beyond the middle of a plate";
            if (GetParam() != 1) {
              EXPECT_TRUE(flight.crossed);
            }
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Walls, Tunnelling, ::testing::Values(0, 1, 2, 3));

// The same masses, asked of the body alone, do go through: the tests above test something.
TEST(ContactTracker, WithoutItAHeavyMassGoesThroughASheet) {
  const Body body = MakeBody(test::SheetMesh(0.2, 0.2, 5));
  Mass m{kHeavy, {-0.02, 0, 0.02}, {0, 0, -kSpeed}};
  for (int i = 0; i < 60; ++i) {
    const Clearance c = body.Query(m.p, kReach);
    const double force = kLaw.Evaluate(kRadius - c.distance, -m.v.dot(c.normal)).value;
    m.v += kStep * force / m.mass * c.normal;
    m.p += kStep * m.v;
  }
  EXPECT_LT(m.p.z(), -kRadius);
}

TEST(ContactTracker, SlidesOnAlongACurvedShellAfterCrossing) {
  // Part of a tube of radius 0.1 around y, open at both ends: a shell.
  TriangleMesh tube;
  const int n = 60;
  for (int i = 0; i <= n; ++i) {
    const double angle = M_PI * i / n;
    for (double y : {-0.1, 0.1})
      tube.vertices.push_back({0.1 * std::cos(angle), y, 0.1 * std::sin(angle)});
    if (i == 0) continue;
    tube.triangles.push_back({2 * i - 2, 2 * i - 1, 2 * i});
    tube.triangles.push_back({2 * i - 1, 2 * i + 1, 2 * i});
  }
  const Body body = MakeBody(tube);
  ContactTracker tracker;
  // Down to 1 mm beneath the outer side, then along beneath it by a right angle.
  for (int i = 6; i >= -1; --i) Track(&tracker, body, {0, 0, 0.1 + i * 1e-3});
  // A facet's middle lies r (1 - cos(pi / 2n)) = 0.034 mm within the tube.
  constexpr double kFacet = 4e-5;
  for (double angle = M_PI / 2; angle > 0.2; angle -= 0.01) {
    const Vector3d radial(std::cos(angle), 0, std::sin(angle));
    const TrackedClearance seen = Track(&tracker, body, 0.099 * radial);
    ASSERT_TRUE(seen.crossed);
    ASSERT_NEAR(seen.distance, -1e-3, kFacet);
    // Within half a facet's angle, and the foot's shift over a facet's edge.
    ASSERT_GT(seen.normal.dot(radial), std::cos(0.06));
  }
}

TEST(ContactTracker, SlidingOffTheRimDoesNotSnap) {
  const Body body = MakeBody(test::SheetMesh(0.2, 0.2, 4));
  ContactTracker tracker;
  double last_distance = 0;
  Vector3d last_normal = Vector3d::UnitZ();
  const double step = 1e-4, height = 2e-3;
  for (double x = 0.09; x < 0.11; x += step) {
    const Vector3d p(x, 0.013, height);
    const TrackedClearance seen = Track(&tracker, body, p);
    const double beyond = std::max(0.0, x - 0.1);
    ASSERT_TRUE(seen.exact || beyond > kRadius);
    if (!seen.exact) break;
    ASSERT_NEAR(seen.distance, std::hypot(beyond, height), kRounding);
    if (x > 0.09) {
      // 1-Lipschitz, and the direction turns about a point `height` away at the nearest.
      ASSERT_LE(std::abs(seen.distance - last_distance), step + kRounding);
      ASSERT_LE((seen.normal - last_normal).norm(), step / height + kRounding);
    }
    last_distance = seen.distance;
    last_normal = seen.normal;
  }
}

TEST(ContactTracker, GoesAroundTheRimToTheOtherSide) {
  const Body body = MakeBody(test::SheetMesh(0.2, 0.2, 4));
  ContactTracker tracker;
  const double r = 2e-3;
  for (double angle = M_PI / 2; angle > -M_PI / 2; angle -= 0.1) {
    const TrackedClearance seen =
        Track(&tracker, body, {0.1 + r * std::cos(angle), 0.013, r * std::sin(angle)});
    ASSERT_FALSE(seen.crossed);
    ASSERT_NEAR(seen.distance, r, kRounding);
  }
  for (double x = 0.1; x > 0.05; x -= 1e-3) {
    const TrackedClearance seen = Track(&tracker, body, {x, 0.013, -r});
    ASSERT_FALSE(seen.crossed);
    ASSERT_NEAR(seen.distance, r, kRounding);
    ASSERT_NEAR(seen.normal.z(), -1, 0.1) << "within the step at the rim";
  }
}

// Around the edges of a plate thinner than the cable, touching all the way.
TEST(ContactTracker, GoesAroundAThinPlatesEdge) {
  const Body body = MakeBody(test::BoxMesh({0.2, 0.2, 0.002}));
  ContactTracker tracker;
  const double r = 2e-3;
  std::vector<Vector3d> path;
  for (double x = 0.09; x < 0.1; x += 5e-4) path.push_back({x, 0, 0.001 + r});
  for (double a = M_PI / 2; a > 0; a -= 0.2)
    path.push_back({0.1 + r * std::cos(a), 0, 0.001 + r * std::sin(a)});
  for (double a = 0; a > -M_PI / 2; a -= 0.2)
    path.push_back({0.1 + r * std::cos(a), 0, -0.001 + r * std::sin(a)});
  for (double x = 0.1; x > 0.09; x -= 5e-4) path.push_back({x, 0, -0.001 - r});
  for (const Vector3d& p : path) {
    const TrackedClearance seen = Track(&tracker, body, p);
    ASSERT_FALSE(seen.crossed);
    ASSERT_NEAR(seen.distance, r, kRounding);
  }
  EXPECT_NEAR(Track(&tracker, body, path.back()).normal.z(), -1, kRounding);
}

// Between two walls the nearest one changes, with opposite normals, and nothing was crossed.
TEST(ContactTracker, ANarrowGapIsNoCrossing) {
  const Body body = MakeBody(
      test::Joined(test::SheetMesh(0.2, 0.2, 3),
                   test::Moved(test::SheetMesh(0.2, 0.2, 3), {{0, 0, 0.006}, {1, 0, 0, 0}})));
  ContactTracker tracker;
  for (double z = 1e-3; z < 5e-3; z += 2e-4) {
    const TrackedClearance seen = Track(&tracker, body, {0.013, 0.007, z});
    ASSERT_FALSE(seen.crossed);
    ASSERT_NEAR(seen.distance, std::min(z, 0.006 - z), kRounding);
  }
}

TEST(ContactTracker, ClearlyApartOnTheOtherSideIsANewStart) {
  const Body body = MakeBody(test::SheetMesh(0.2, 0.2, 3));
  ContactTracker tracker;
  Track(&tracker, body, {0, 0, 1e-3});
  const TrackedClearance behind = Track(&tracker, body, {0, 0, -2e-3});
  EXPECT_TRUE(behind.crossed);
  EXPECT_NEAR(behind.distance, -2e-3, kRounding);
  const TrackedClearance through = Track(&tracker, body, {0, 0, -2.7e-3});
  EXPECT_FALSE(through.crossed);
  EXPECT_NEAR(through.distance, 2.7e-3, kRounding);
  EXPECT_NEAR(through.normal.z(), -1, kRounding);
}

// Never less than the truth when exact is claimed, never more than the truth otherwise, and mostly
// without a query.
TEST(ContactTracker, CachedBoundsHoldAndSaveQueries) {
  const Body body = MakeBody(test::Moved(test::UrchinMesh(0.1, 15, 21), test::SomePose()));
  test::RandomPoints random(5);
  int queries = 0, steps = 0;
  for (int walk = 0; walk < 20; ++walk) {
    ContactTracker tracker;
    Vector3d p = test::SomePose().p + 0.2 * random.Direction();
    for (int i = 0; i < 500; ++i, ++steps) {
      const Vector3d next = p + 5e-4 * random.Direction();
      const double truth = body.Query(next, std::numeric_limits<double>::infinity()).distance;
      if (truth < 0) continue;  // stay outside: the side is not what is tested here
      p = next;
      const TrackedClearance seen = Track(&tracker, body, p);
      queries += seen.exact ? 1 : 0;
      if (seen.exact) {
        ASSERT_NEAR(seen.distance, truth, kRounding);
      } else {
        ASSERT_LE(seen.distance, truth + kRounding);
        ASSERT_GT(seen.distance, kRadius + kMargin);
      }
    }
  }
  EXPECT_LT(queries, steps / 4);
}

TEST(ContactTracker, LookingChangesNothingAndCopiesAreIndependent) {
  const Body body = MakeBody(test::SheetMesh(0.2, 0.2, 3));
  ContactTracker tracker;
  Track(&tracker, body, {0, 0, 1e-3});
  const ContactTracker before = tracker;
  // A tried step that crosses, and one farther on: both are judged from what was accepted.
  EXPECT_NEAR(tracker.Look(body, {0, 0, -1e-3}, kRadius, kMargin, kReach).distance, -1e-3,
              kRounding);
  EXPECT_NEAR(tracker.Look(body, {0, 0, -2e-3}, kRadius, kMargin, kReach).distance, -2e-3,
              kRounding);
  EXPECT_NEAR(tracker.Look(body, {0, 0, 1e-3}, kRadius, kMargin, kReach).distance, 1e-3, kRounding);
  Track(&tracker, body, {0, 0, 0.03});
  EXPECT_NEAR(before.Look(body, {0, 0, -1e-3}, kRadius, kMargin, kReach).distance, -1e-3,
              kRounding);
}

TEST(ContactTracker, NothingWithinReach) {
  const Body body = MakeBody(test::SheetMesh(0.2, 0.2, 3));
  ContactTracker tracker;
  const TrackedClearance seen = Track(&tracker, body, {0, 0, 0.5});
  EXPECT_FALSE(seen.exact);
  EXPECT_NEAR(seen.distance, 0.5, kRounding);
  const Body empty{std::vector<Shape>()};
  EXPECT_EQ(ContactTracker().Look(empty, {0, 0, 0}, kRadius, kMargin, kReach).distance,
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace cosserat_cable
