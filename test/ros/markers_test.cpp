#include "cosserat_cable/ros/markers.h"

#include <gtest/gtest.h>
#include <ros/serialization.h>

#include <cmath>

namespace cosserat_cable {
namespace {

TEST(MarkersTest, InterpolationFollowsACircle) {
  // A quarter circle in the x-z plane, of length 1, in ten elements.
  constexpr int kElements = 10;
  const double radius = 2 / M_PI;
  const auto on_circle = [&](double s) {
    const double angle = s / radius;
    Pose pose;
    pose.p = {radius * (1 - std::cos(angle)), 0, radius * std::sin(angle)};
    pose.q = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY());
    return pose;
  };
  std::vector<Pose> nodes;
  for (int i = 0; i <= kElements; ++i) nodes.push_back(on_circle(0.1 * i));
  // Cubic Hermite: h^4/384 of the fourth derivative, 1/radius^3.
  constexpr double kTolerance = 2e-6;
  for (double s = 0; s <= 1; s += 0.013) {
    const Pose pose = InterpolateNodes(nodes, 1, s);
    EXPECT_LT((pose.p - on_circle(s).p).norm(), kTolerance) << s;
    EXPECT_LT(pose.q.angularDistance(on_circle(s).q), 1e-7) << s;
  }
  EXPECT_LT((InterpolateNodes(nodes, 1, 0.3).p - nodes[3].p).norm(), 1e-15);  // rounding
}

TEST(MarkersTest, ColoursAreViridis) {
  // Matplotlib's table at 0, 128/255 and 255.
  constexpr double kTolerance = 0.02;
  EXPECT_LT((ViridisColor(0) - Eigen::Vector3d(0.267, 0.005, 0.329)).norm(), kTolerance);
  EXPECT_LT((ViridisColor(0.502) - Eigen::Vector3d(0.128, 0.567, 0.551)).norm(), kTolerance);
  EXPECT_LT((ViridisColor(7) - Eigen::Vector3d(0.993, 0.906, 0.144)).norm(), kTolerance);
}

}  // namespace
}  // namespace cosserat_cable
