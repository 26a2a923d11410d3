// Published large motions, through the public interface.
#include <gtest/gtest.h>

#include "rod/published_rods.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

TEST(PublishedMotion, RubberRodPendulum) {
  // Lang, Linn and Arnold 2011: a rubber rod, pinned at one end, dropped from the horizontal.
  constexpr double kWithin = 0.01;  // of the length
  constexpr int kElements = 40;
  constexpr double kDt = 5e-4;
  Rod rod = RubberRodPendulum(kElements);
  const Pose pin = rod.pose(0);
  const double at[] = {0.3, 0.5, 0.7};
  const double x[] = {0.798, -0.233, -0.863}, z[] = {-0.425, -0.920, -0.502};
  int next = 0;
  for (int k = 1; next < 3; ++k) {
    ASSERT_TRUE(rod.Step(kDt, pin, pin).converged) << k * kDt;
    if (k * kDt < at[next] - 0.5 * kDt) continue;
    const std::string name = "rubber rod pendulum at " + std::to_string(at[next]).substr(0, 3);
    const char* source = "Lang, Linn and Arnold 2011";
    const Vector3d tip = rod.pose(kElements).p;
    Validate({"Motion", name + " s: tip x [m]", source, x[next], tip.x(), kWithin, kElements, kDt});
    Validate({"Motion", name + " s: tip z [m]", source, z[next], tip.z(), kWithin, kElements, kDt});
    ++next;
  }
}

}  // namespace
}  // namespace cosserat_cable::rod
