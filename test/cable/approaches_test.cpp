// What is known of a cable's distance from bodies while both move, against the distance itself.
#include "../../src/cable/approaches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/meshes.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-12;  // [m], of positions of some metres
constexpr double kSpin = 0.3;        // [rad] in a step
constexpr double kWay = 0.01;        // [m] in a step

Eigen::Quaterniond Turn(double angle, const Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

TriangleMesh WheelMesh() {
  TriangleMesh mesh = test::SphereMesh(0.3, 12, 24);
  for (Vector3d& v : mesh.vertices) v.y() *= 0.3;
  return mesh;
}

/// A cable beside a wheel that spins about its y, and a box; all on a vehicle that moves.
class ApproachesTest : public ::testing::Test {
 protected:
  ApproachesTest()
      : wheel_(test::MakeBody(WheelMesh())),
        box_(test::MakeBody(test::BoxMesh({0.3, 0.2, 0.1}))),
        motions_(2),
        approaches_({&wheel_, &box_}) {
    for (int i = 0; i <= 40; ++i) nodes_.push_back({0.5 + 0.01 * i, 0.05 * std::sin(0.1 * i), 0});
    motions_[1].X.p = {0.7, 0.5, 0};
  }

  PointRows Rows() const {
    PointRows rows;
    std::vector<Vector3d> nodes_W;
    for (const Vector3d& p : nodes_) nodes_W.push_back(vehicle_ * p);
    rows.Assign(nodes_W);
    return rows;
  }
  std::vector<Motion> Bodies() const {
    std::vector<Motion> bodies = motions_;
    for (Motion& body : bodies) body.X = vehicle_ * body.X;
    return bodies;
  }
  void Move() { approaches_.Move(vehicle_, Rows(), Bodies()); }
  const Body& body(std::size_t b) const { return b == 0 ? wheel_ : box_; }
  void Look() {
    for (std::size_t b = 0; b < motions_.size(); ++b) {
      PointRows nodes_B;
      nodes_B.Assign(Rows(), Bodies()[b].X);
      approaches_.Set(b, body(b).LowerBoundTurned(nodes_B));
    }
  }
  double Distance(std::size_t b) const {
    double distance = kInfinity;
    for (const Vector3d& p : nodes_)
      distance = std::min(distance, body(b).Query(motions_[b].X.Inverse() * p, kInfinity).distance);
    return distance;
  }

  Body wheel_, box_;
  Pose vehicle_;
  std::vector<Vector3d> nodes_;  // on the vehicle [m]
  std::vector<Motion> motions_;  // likewise
  Approaches approaches_;
};

TEST_F(ApproachesTest, NothingIsKnownAtFirst) {
  Move();
  EXPECT_EQ(approaches_.at_least(0), -kInfinity);
  EXPECT_EQ(approaches_.at_least(1), -kInfinity);
}

TEST_F(ApproachesTest, NeitherTheVehicleNorASpinningWheelComesNearer) {
  Move();
  Look();
  const double wheel = approaches_.at_least(0), box = approaches_.at_least(1);
  EXPECT_GT(wheel, 0.1);
  EXPECT_GT(box, 0.1);
  for (int k = 1; k <= 100; ++k) {
    vehicle_ = {{0.03 * k, 0.2, 0}, Turn(0.01 * k, {0, 0, 1})};
    motions_[0].X.q = Turn(kSpin * k, {0, 1, 0});
    Move();
  }
  EXPECT_NEAR(approaches_.at_least(0), wheel, kRounding);
  EXPECT_NEAR(approaches_.at_least(1), box, kRounding);
}

TEST_F(ApproachesTest, NoBodyIsNearerThanTheBoundHoweverAllMove) {
  test::RandomPoints random(5);
  for (int round = 0; round < 200; ++round) {
    for (Motion& body : motions_)
      body.X = {random.InCube(0.8), Turn(random.In(0, 3), random.Direction())};
    Move();
    Look();
    const double spin = random.In(-kSpin, kSpin);
    for (int k = 0; k < 5; ++k) {
      vehicle_ = vehicle_ * Pose{random.InCube(kWay), Turn(kWay, random.Direction())};
      for (Motion& body : motions_)
        body.X = body.X * Pose{random.InCube(kWay), Turn(kWay, random.Direction())};
      motions_[0].X.q = motions_[0].X.q * Turn(spin, {0, 1, 0});
      for (Vector3d& p : nodes_) p += random.InCube(0.1 * kWay);
      Move();
      for (std::size_t b = 0; b < motions_.size(); ++b)
        EXPECT_LE(approaches_.at_least(b), Distance(b) + kRounding) << round;
    }
  }
}

TEST_F(ApproachesTest, ANodeThatIsNotFiniteLeavesNothingKnown) {
  Move();
  Look();
  const Vector3d before = nodes_[7];
  nodes_[7].x() = std::numeric_limits<double>::quiet_NaN();
  Move();
  nodes_[7] = before;
  Move();
  EXPECT_FALSE(approaches_.at_least(1) > -kInfinity);
}

}  // namespace
}  // namespace cosserat_cable
