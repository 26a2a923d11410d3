#include "cosserat_cable/rod/element_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cosserat_cable/rod/point_loads.h"
#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

TEST(ElementCurveTest, FollowsAHelixExactly) {
  constexpr double kRounding = 1e-14;
  static constexpr double kRadius = 0.3, kRise = 0.1;  // [m], [m per rad]
  const auto on_helix = [](double angle) {
    Pose pose;
    pose.p = {kRadius * (1 - std::cos(angle)), kRadius * std::sin(angle), kRise * angle};
    // The section is carried along with the helix, its normal along the tangent.
    const Vector3d tangent(0, kRadius, kRise);
    pose.q = AngleAxisd(-angle, Vector3d::UnitZ()) *
             Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), tangent);
    return pose;
  };
  for (const double step : {1e-3, 0.1, 1.0}) {
    const ElementCurve curve(on_helix(0.4), on_helix(0.4 + step));
    for (double t = 0; t <= 1; t += 0.125) {
      const Pose at = curve.At(t), expected = on_helix(0.4 + t * step);
      EXPECT_LT((at.p - expected.p).norm(), kRounding) << step << ' ' << t;
      EXPECT_LT((at.q.toRotationMatrix() - expected.q.toRotationMatrix()).norm(), kRounding);
    }
  }
}

TEST(ElementCurveTest, ErrorIsThatOfACubicInTheSecondDerivativeOfTheCurvature) {
  // A clothoid-like plane curve: its direction is angle(s) = sin(s), so that all derivatives of the
  // curvature are at most one. Positions by Simpson's rule in many steps.
  const auto on_curve = [](double s) {
    constexpr int kSteps = 2000;
    Vector3d p = Vector3d::Zero();
    for (int k = 0; k <= kSteps; ++k) {
      const double angle = std::sin(s * k / kSteps);
      const double weight = k == 0 || k == kSteps ? 1 : k % 2 ? 4 : 2;
      p += weight * Vector3d(std::sin(angle), 0, std::cos(angle));
    }
    return Pose{s / (3.0 * kSteps) * p,
                Eigen::Quaterniond(AngleAxisd(std::sin(s), Vector3d::UnitY()))};
  };
  // 1/384 for what the cubic leaves out, and products of the lower derivatives with that.
  constexpr double kLeftOut = 2.0 / 384;
  for (const double h : {0.2, 0.1, 0.05})
    for (const double s : {0.3, 1.0, 1.5, 2.2}) {
      const ElementCurve curve(on_curve(s), on_curve(s + h));
      for (double t = 0.1; t < 1; t += 0.2)
        EXPECT_LT((curve.At(t).p - on_curve(s + t * h).p).norm(), kLeftOut * std::pow(h, 4))
            << h << ' ' << s << ' ' << t;
    }
}

TEST(ElementCurveTest, ReachesBothNodes) {
  constexpr double kRounding = 1e-15;
  const Pose a{{1, 2, 3}, Eigen::Quaterniond(AngleAxisd(0.3, Vector3d(1, 2, 0).normalized()))};
  const Pose b{{1.01, 2.02, 3.05}, Eigen::Quaterniond(AngleAxisd(0.7, Vector3d::UnitX()))};
  const ElementCurve curve(a, b);
  EXPECT_LT((curve.At(0).p - a.p).norm(), kRounding);
  EXPECT_LT((curve.At(1).p - b.p).norm(), 4 * kRounding);  // of size 4
}

TEST(ElementCurveTest, AShearedCantileverBendsAsTimoshenkoSays) {
  // w(s) = F (s^2 (3 L - s)/(6 EI) + s/GA) of a weightless cantilever with a small force at its
  // tip. The element is nodally exact for it; the displacement is of first order in the load, what
  // is left out of third.
  constexpr double kL = 0.3, kEI = 2e-3, kGA = 90, kF = 1e-5;
  constexpr double kRelative = 1e-6;
  for (const int elements : {7, 20}) {
    RodModel model = RoundCable(kL, 0.01, 0.03, kEI, 1.5e-3, 0, 0, elements);
    model.section.C_F = {kGA, kGA, 300};
    model.gravity.setZero();
    model.b = EndModel::Free();
    Rod rod(model);
    std::vector<Pose> nodes(static_cast<std::size_t>(elements) + 1);
    for (int i = 0; i <= elements; ++i)
      nodes[static_cast<std::size_t>(i)].p.z() = kL * i / elements;
    rod.SetConfiguration(nodes);
    const PointLoads load(kL, {{kL, {kF, 0, 0}, Vector3d::Zero(), false}});
    ASSERT_TRUE(rod.Equilibrate(&load).converged);
    const double tip = kF * (kL * kL * kL / (3 * kEI) + kL / kGA);
    for (int e = 0; e < elements; ++e)
      for (const double t : {0.2, 0.5, 0.7}) {
        const double s = (e + t) * kL / elements;
        const double w = kF * (s * s * (3 * kL - s) / (6 * kEI) + s / kGA);
        EXPECT_NEAR(ElementCurve(rod, e).At(t).p.x(), w, kRelative * tip) << e << ' ' << t;
      }
  }
}

TEST(ElementCurveTest, BeginsBehindTheElbow) {
  constexpr double kRounding = 1e-15;
  RodModel model = RoundCable(1.0, 0.01, 0.03, 2e-3, 1.5e-3, 0, 0, 10);
  const Eigen::Quaterniond elbow(AngleAxisd(M_PI / 2, Vector3d::UnitY()));  // from z to x
  model.joints.push_back({0.5, elbow});
  Rod rod(model);
  std::vector<Pose> nodes(11);
  for (int i = 0; i <= 10; ++i) {
    Pose& node = nodes[static_cast<std::size_t>(i)];
    node.p = i <= 5 ? Vector3d(0, 0, 0.1 * i) : Vector3d(0.1 * (i - 5), 0, 0.5);
    if (i > 5) node.q = elbow;
  }
  rod.SetConfiguration(nodes);
  EXPECT_LT((ElementCurve(rod, 5).At(0.3).p - Vector3d(0.03, 0, 0.5)).norm(), kRounding);
  EXPECT_LT((ElementCurve(rod, 4).At(0.3).p - Vector3d(0, 0, 0.43)).norm(), kRounding);
}

}  // namespace
}  // namespace cosserat_cable::rod
