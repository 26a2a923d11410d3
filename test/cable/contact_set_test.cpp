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
constexpr double kLanding =
    6.9e-3;  // the longest way that a step may take: 5 mm + 2 mm, and not all
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
  Quat<double> orientation(int) const override { return {1, 0, 0, 0}; }

 private:
  std::vector<Vector3d> nodes_;
};

/// A sheet in the plane z = 0; with scraps far off above and below, so that no simple solid around
/// the body tells that a point is away from the sheet.
Body Sheet() {
  TriangleMesh mesh = test::SheetMesh(1, kWidth, 4);
  for (const double z : {-0.2, 0.2})
    mesh = test::Joined(mesh, test::Moved(test::SheetMesh(0.02, kWidth, 1),
                                          {{0.45, 0, z}, Eigen::Quaterniond::Identity()}));
  return test::MakeBody(mesh);
}

/// A cable over a sheet in the plane z = 0, whose two halves are moved by hand. The left one lies
/// along x. The right one is a steep zigzag, whose elements touch by their ends: only there does a
/// bound by an element's middle let its ends come near without a look.
class ContactSetTest : public ::testing::Test {
 protected:
  ContactSetTest() : sheet_(Sheet()), set_(Cable(), {&sheet_}) {
    Place({0, kTouching}, {0, kTouching});
  }

  /// The halves' y and z [m].
  void Place(const Eigen::Vector2d& left, const Eigen::Vector2d& right) {
    left_ = left;
    right_ = right;
    std::vector<Vector3d> nodes;
    const int half = Cable().elements / 2;
    const double h = Cable().length / Cable().elements;
    for (int i = 0; i <= half; ++i) nodes.push_back({h * (i - half), left[0], left[1]});
    for (int i = 1; i <= half; ++i)
      nodes.push_back({0.1 * h * i, right[0], right[1] + (i % 2 ? zigzag_ : 0)});
    set_.Search(Pose(), nodes, {Motion()});
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
  double zigzag_ = 9e-3;  // of the right half: the way that the other ends of its elements point
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
  zigzag_ = -zigzag_;
  MoveRight({0, -0.06});
  // The last step goes from where nothing is looked at to where the side must be known.
  MoveRight({0, -kTouching - kLanding});
  Place(left_, {0, -kTouching});
  EXPECT_EQ(SideOfHalf(true), -1);
  // The other half was near all the time.
  EXPECT_EQ(SideOfHalf(false), 1);
}

TEST_F(ContactSetTest, ResetForgetsAllSides) {
  set_.Reset();
  zigzag_ = -zigzag_;
  Place({0, -kTouching}, {0, -kTouching});
  EXPECT_EQ(SideOfHalf(false), -1);
  EXPECT_EQ(SideOfHalf(true), -1);
}

}  // namespace
}  // namespace cosserat_cable
