// Two straight pieces joined at a right angle: published buckling and motion.
#include <gtest/gtest.h>

#include <vector>

#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/point_loads.h"
#include "rod/rod_cases.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Frames along z for the first half, then along x: the elbow turns by 90 degrees about y.
const Quaterniond kElbow(AngleAxisd(M_PI / 2, Vector3d::UnitY()));

std::vector<Pose> RightAngle(double leg, int elements) {
  const double h = 2 * leg / elements;
  std::vector<Pose> nodes;
  for (int i = 0; i <= elements; ++i) {
    const int beyond = i - elements / 2;
    if (beyond <= 0)
      nodes.push_back({{0, 0, i * h}, Quaterniond::Identity()});
    else
      nodes.push_back({{beyond * h, 0, leg}, kElbow});
  }
  return nodes;
}

TEST(RightAngleTest, TheElbowStaysARightAngle) {
  RodModel model = RoundCable(0.2, 0.004, 0.05, 0.02, 0.015, 1e-4, 1e-4, 20);
  model.gravity.setZero();
  model.b = EndModel::Free();
  model.joints = {{0.1, kElbow}};
  Rod rod(model);
  rod.SetConfiguration(RightAngle(0.1, 20));
  EXPECT_TRUE(rod.Equilibrate().converged);
  EXPECT_NEAR(rod.elastic_energy(), 0, 1e-20);
  const PointLoads pull(0.2, {{0.2, {3.0, 0, 0}}});
  ASSERT_TRUE(rod.Equilibrate(&pull).converged);
  // The first leg bends under the pull and its moment; the elbow stays a right angle.
  const Vector3d before = rod.pose(10).q * Vector3d::UnitZ();
  const Vector3d behind = rod.pose(10).q * kElbow * Vector3d::UnitZ();
  EXPECT_NEAR(before.dot(behind), 0, 1e-12);
  EXPECT_GT(rod.pose(10).p.x(), 1e-3);
  // The second leg is nearly along the pull.
  EXPECT_NEAR(rod.force(19).z(), 3.0, 0.1);
  const Pose clamp;
  for (int k = 0; k < 200; ++k) ASSERT_TRUE(rod.Step(1e-3, clamp, clamp, &pull).converged);
  EXPECT_LT(std::abs(rod.energy_balance().Residual()), 1e-9);
}

TEST(RightAngleTest, JointsAreAtNodesBetweenTheEnds) {
  RodModel model = RoundCable(0.2, 0.004, 0.05, 0.02, 0.015, 1e-4, 1e-4, 20);
  for (const double s : {0.0, 0.2, 0.0153}) {
    model.joints = {{s, kElbow}};
    EXPECT_THROW(Rod{model}, std::invalid_argument) << s;
  }
}

/// Whether the frame is stable under a load at its tip, along the first leg and away from the clamp
/// [N].
bool IsStableUnder(double load, int elements) {
  constexpr double kLeg = 240, kDeep = 30, kThin = 0.6, kE = 71240, kNu = 0.31;
  constexpr double kG = kE / (2 * (1 + kNu)), kA = kDeep * kThin;
  RodModel model;
  model.length = 2 * kLeg;
  model.elements = elements;
  // In the plane (x, z) of the frame it is deep: bending about a2 = y is stiff, about a1 soft.
  model.section.C_F = {kG * kA, kG * kA, kE * kA};
  model.section.C_M = {kE * kDeep * std::pow(kThin, 3) / 12, kE * kThin * std::pow(kDeep, 3) / 12,
                       kG * kDeep * std::pow(kThin, 3) / 3};
  model.section.V_F.setZero();
  model.section.V_M.setZero();
  model.section.rhoA = 1e-3;
  model.section.rhoJ = {1e-3, 1e-3, 2e-3};
  model.gravity.setZero();
  model.b = EndModel::Free();
  model.joints = {{kLeg, kElbow}};
  Rod rod(model);
  rod.SetConfiguration(RightAngle(kLeg, elements));
  const PointLoads force(model.length, {{model.length, {0, 0, load}}});
  EXPECT_TRUE(rod.Equilibrate(&force).converged) << load;
  return !FindModes(rod, 1, &force)[0].unstable();
}

TEST(RightAngleTest, FrameBucklesSideways) {
  // Argyris et al. 1979: clamped at the end of one leg, loaded at that of the other, in its plane.
  constexpr double kWithin = 3e-3;  // relative
  constexpr int kElements = 40;
  double stable = 0.5, unstable = 2.0;
  while (unstable - stable > 1e-4) {
    const double load = 0.5 * (stable + unstable);
    (IsStableUnder(load, kElements) ? stable : unstable) = load;
  }
  Validate({"Statics", "right-angle frame, lateral buckling under an end load: P",
            "Argyris et al. 1979", 1.088, 0.5 * (stable + unstable), kWithin * 1.088, kElements});
}

TEST(RightAngleTest, CantileverSwungByAForceAtItsElbow) {
  // Simo and Vu-Quoc 1988: a hat of 50 within two seconds, across the plane; then it swings freely
  // with deflections as large as its legs.
  constexpr double kWithin = 0.01;  // relative
  constexpr int kElements = 40;
  constexpr double kDt = 0.01, kLeg = 10;
  RodModel model;
  model.length = 2 * kLeg;
  model.elements = kElements;
  model.section.C_F.setConstant(1e6);
  model.section.C_M.setConstant(1e3);
  model.section.V_F.setZero();
  model.section.V_M.setZero();
  model.section.rhoA = 1;
  model.section.rhoJ = {10, 10, 20};
  model.gravity.setZero();
  model.b = EndModel::Free();
  model.joints = {{kLeg, kElbow}};
  Rod rod(model);
  rod.SetConfiguration(RightAngle(kLeg, kElements));
  PointLoads push(model.length, {{kLeg}});
  const Pose clamp;
  std::vector<double> elbow, tip, energy;
  for (int k = 1; k * kDt <= 16.5; ++k) {
    const double t = k * kDt;
    push.loads[0].force.y() = 50 * std::max(0.0, 1 - std::abs(t - 1));
    ASSERT_TRUE(rod.Step(kDt, clamp, clamp, &push).converged) << t;
    elbow.push_back(rod.pose(kElements / 2).p.y());
    tip.push_back(rod.pose(kElements).p.y());
    energy.push_back(rod.kinetic_energy() + rod.elastic_energy());
  }
  const auto extreme = [&](const std::vector<double>& x, double around, double sign) {
    double best = 0;
    for (int k = 0; k < static_cast<int>(x.size()); ++k)
      if (std::abs((k + 1) * kDt - around) < 0.5) best = std::max(best, sign * x[k]);
    return sign * best;
  };
  const char* source = "Simo and Vu-Quoc 1988";
  const auto validate = [&](const char* what, double target, double ours) {
    Validate({"Motion", what, source, target, ours, kWithin * std::abs(target), kElements, kDt});
  };
  validate("right-angle cantilever, elbow at 3.1 s", 5.509, extreme(elbow, 3.10, 1));
  validate("right-angle cantilever, tip at 7.4 s", 8.242, extreme(tip, 7.44, 1));
  validate("right-angle cantilever, tip at 15.9 s", -9.727, extreme(tip, 15.88, -1));
  const double after = energy[static_cast<int>(2.5 / kDt)];
  validate("right-angle cantilever, energy at 16 s / at 2.5 s", 1, energy.back() / after);
}

}  // namespace
}  // namespace cosserat_cable::rod
