#include "cosserat_cable/ros/markers.h"

#include <gtest/gtest.h>
#include <ros/serialization.h>

#include <cmath>

#include "cable/cable_cases.h"

namespace cosserat_cable {
namespace {

TEST(MarkersTest, ColoursAreViridis) {
  // Matplotlib's table at 0, 128/255 and 255.
  constexpr double kTolerance = 0.02;
  EXPECT_LT((ViridisColor(0) - Eigen::Vector3d(0.267, 0.005, 0.329)).norm(), kTolerance);
  EXPECT_LT((ViridisColor(0.502) - Eigen::Vector3d(0.128, 0.567, 0.551)).norm(), kTolerance);
  EXPECT_LT((ViridisColor(7) - Eigen::Vector3d(0.993, 0.906, 0.144)).norm(), kTolerance);
}

/// A cable between two clamps, `chord` apart and both along x.
CableSimulation Hang(double chord) {
  CableModel model = RoundCableModel(0.4, 0.01, 0.1, 0.03, 0.03, 1e-4);
  CableSimulation cable(model, {}, {0, 0, -9.81});
  Surroundings clamps;
  clamps.a.X.q = clamps.b.X.q = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY());
  clamps.b.X.p.x() = chord;
  EXPECT_TRUE(cable.Settle(clamps).ok);
  return cable;
}

const visualization_msgs::Marker& Tube(const visualization_msgs::MarkerArray& markers) {
  return markers.markers.front();
}

TEST(MarkersTest, TheTubeLiesOnTheCablesSurface) {
  const CableSimulation cable = Hang(0.25);
  const visualization_msgs::MarkerArray markers = MakeMarkers(cable, Pose(), 1, MarkerStyle());
  const visualization_msgs::Marker& tube = Tube(markers);
  ASSERT_EQ(tube.points.size() % 3, 0u);
  ASSERT_EQ(tube.colors.size(), tube.points.size());
  // A hexagon's corners, as far outside of the circle as the middles of its sides are inside.
  constexpr double kDeviation = 0.08;  // of the radius
  const double radius = cable.model().diameter / 2;
  for (const geometry_msgs::Point& point : tube.points) {
    double nearest = 1;
    for (const Pose& X : cable.nodes())
      nearest = std::min(nearest, (X.p - Eigen::Vector3d(point.x, point.y, point.z)).norm());
    EXPECT_NEAR(nearest, radius, kDeviation * radius);
  }
}

TEST(MarkersTest, StraightCablesHaveFewTriangles) {
  // Straight but for its sag, and bent through more than a turn in all.
  const auto triangles = [](double chord) {
    return Tube(MakeMarkers(Hang(chord), Pose(), 1, MarkerStyle())).points.size() / 3;
  };
  EXPECT_LT(triangles(0.4), 6u * 2u * 4u);
  EXPECT_GT(triangles(0.1), 6u * 2u * 12u);
}

}  // namespace
}  // namespace cosserat_cable
