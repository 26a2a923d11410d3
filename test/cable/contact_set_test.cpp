// Which side of a two-sided shell a cable belongs to, and when that is forgotten.
#include "../../src/cable/contact_set.h"

#include <gtest/gtest.h>

#include "cable/cable_cases.h"
#include "contact/meshes.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

constexpr double kWidth = 0.06;  // of the sheet, across the cable [m]
constexpr double kStep = 4e-3;   // a way in one step [m]; a point may go its radius and a bit more
constexpr double kTouching = 4e-3;  // height of the centreline on the sheet [m]; the radius is 5 mm

CableModel Cable() { return RoundCableModel(0.4, 0.01, 0.12, 0.035, 0.028, 1e-4); }

/// A centreline at rest, put where the test wants it.
class Placed : public rod::Centreline {
 public:
  explicit Placed(std::vector<Vector3d> nodes) : nodes_(std::move(nodes)) {}
  int elements() const override { return static_cast<int>(nodes_.size()) - 1; }
  Vec3<double> position(int node) const override {
    const Vector3d& p = nodes_[static_cast<std::size_t>(node)];
    return {p.x(), p.y(), p.z()};
  }
  Vec3<double> velocity(int) const override { return {}; }

 private:
  std::vector<Vector3d> nodes_;
};

/// A cable along x over a sheet in the plane z = 0, whose two halves are moved by hand.
class ContactSetTest : public ::testing::Test {
 protected:
  ContactSetTest()
      : sheet_(test::MakeBody(test::SheetMesh(1, kWidth, 4))), set_(Cable(), {&sheet_}) {
    Place({0, kTouching}, {0, kTouching});
  }

  /// The halves' y and z [m].
  void Place(const Eigen::Vector2d& left, const Eigen::Vector2d& right) {
    left_ = left;
    right_ = right;
    std::vector<Vector3d> nodes;
    const int elements = Cable().elements;
    for (int i = 0; i <= elements; ++i) {
      const Eigen::Vector2d& yz = 2 * i <= elements ? left : right;
      nodes.push_back({Cable().length * (static_cast<double>(i) / elements - 0.5), yz[0], yz[1]});
    }
    set_.Search(nodes, {Motion()});
    set_.Accept();
    points_ = set_.Points(Placed(nodes));
  }

  void MoveRight(const Eigen::Vector2d& to) {
    while (right_ != to) {
      const Eigen::Vector2d way = to - right_;
      const Eigen::Vector2d next =
          way.norm() > kStep ? Eigen::Vector2d(right_ + kStep * way.normalized()) : to;
      Place(left_, next);
    }
  }

  /// The sides that the sheet presses a half to: +1 up, -1 down, 0 none or both. The elements
  /// between the halves belong to neither.
  int SideOfHalf(bool right) const {
    const double middle = Cable().length / 2, between = 2 * Cable().length / Cable().elements;
    int up = 0, down = 0;
    for (const ContactPoint& point : points_) {
      const double beyond = right ? point.s - middle : middle - point.s;
      if (beyond < between) continue;
      (point.force_W.z() > 0 ? up : down) += 1;
    }
    return (up > 0) == (down > 0) ? 0 : up > 0 ? 1 : -1;
  }

  Body sheet_;
  ContactSet set_;
  Eigen::Vector2d left_, right_;
  std::vector<ContactPoint> points_;
};

TEST_F(ContactSetTest, ACableThatStaysNearIsNotLetThrough) {
  MoveRight({0, -kTouching});
  EXPECT_EQ(SideOfHalf(false), 1);
  EXPECT_EQ(SideOfHalf(true), 1);
}

TEST_F(ContactSetTest, NeitherAfterItWasOffTheSurfaceByLessThanItsElements) {
  MoveRight({0, 0.008});
  MoveRight({0, -kTouching});
  EXPECT_EQ(SideOfHalf(true), 1);
}

TEST_F(ContactSetTest, ElementsThatLeftAreAcceptedOnTheOtherSide) {
  MoveRight({0, 0.06});
  EXPECT_EQ(SideOfHalf(true), 0);
  MoveRight({kWidth, 0.06});
  MoveRight({kWidth, -0.06});
  MoveRight({0, -0.06});
  MoveRight({0, -kTouching});
  EXPECT_EQ(SideOfHalf(true), -1);
  // The other half was near all the time.
  EXPECT_EQ(SideOfHalf(false), 1);
}

TEST_F(ContactSetTest, ResetForgetsAllSides) {
  set_.Reset();
  Place({0, -kTouching}, {0, -kTouching});
  EXPECT_EQ(SideOfHalf(false), -1);
  EXPECT_EQ(SideOfHalf(true), -1);
}

}  // namespace
}  // namespace cosserat_cable
