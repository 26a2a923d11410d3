// A section that changes between steps: what the change costs, alone and in lanes.
#include <gtest/gtest.h>

#include <cmath>

#include "cosserat_cable/rod/rod_batch.h"
#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 0.2, kEI = 0.008;

RodModel Cable() {
  RodModel model = RoundCable(kLength, 0.008, 0.15, kEI, 0.006, 1e-5, 1e-5, 20);
  model.gravity.setZero();
  return model;
}

Section Scaled(const Section& section, double factor) {
  Section scaled = section;
  scaled.C_M *= factor;
  return scaled;
}

/// Bent about a2 to the arc of this curvature [1/m], from clamp to clamp.
Rod Arc(double curvature) {
  Rod rod(Cable());
  std::vector<Pose> nodes;
  for (int i = 0; i <= 20; ++i) {
    const double s = kLength * i / 20, angle = curvature * s;
    nodes.push_back({Vector3d((1 - std::cos(angle)) / curvature, 0, std::sin(angle) / curvature),
                     Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY()))});
  }
  rod.SetConfiguration(nodes);
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

TEST(SectionChange, CostsWhatItsStrainsStoreMore) {
  constexpr double kCurvature = 4, kFactor = 1.5;
  Rod rod = Arc(kCurvature);
  const Pose a = rod.pose(0), b = rod.pose(20);
  ASSERT_TRUE(rod.Step(1e-3, a, b).converged);
  rod.SetSection(Scaled(rod.model().section, kFactor));
  ASSERT_TRUE(rod.Step(1e-3, a, b).converged);
  const EnergyBalance balance = rod.energy_balance();
  const double work = 0.5 * (kFactor - 1) * kEI * kCurvature * kCurvature * kLength;
  constexpr double kArcOfElements = 1e-3;
  EXPECT_NEAR(balance.work_section, work, kArcOfElements * work);
  // The arc stays one: nothing moves.
  EXPECT_NEAR(balance.stored, work, kArcOfElements * work);
  EXPECT_NEAR(balance.Residual(), 0, 1e-6 * work);
}

TEST(SectionChange, KeepsTheBalanceOfASwing) {
  Rod rod = Arc(3);
  RodModel model = Cable();
  model.b = EndModel::Free();
  Rod swinging(model);
  std::vector<Pose> nodes;
  for (int i = 0; i <= 20; ++i) nodes.push_back(rod.pose(i));
  swinging.SetConfiguration(nodes);
  const Pose clamp = nodes.front();
  double highest = 0;
  for (int k = 1; k <= 2000; ++k) {
    swinging.SetSection(Scaled(model.section, 1 + 0.3 * k / 2000.0));
    ASSERT_TRUE(swinging.Step(2.5e-4, clamp, clamp).converged);
    highest = std::max(highest, swinging.kinetic_energy());
  }
  const EnergyBalance balance = swinging.energy_balance();
  EXPECT_GT(balance.work_section, 0.02 * highest);
  constexpr double kSteps = 2e-3;  // of the swing's energy
  EXPECT_NEAR(balance.Residual(), 0, kSteps * highest);
}

TEST(SectionChange, InLanesIsThatOfOneRodOnly) {
  Rod first = Arc(3), second = Arc(3), changed = Arc(3), alone = Arc(3), beside = Arc(3);
  const Pose a = first.pose(0);
  Pose b = first.pose(20);
  RodBatch plain({&first, &second}), mixed({&changed, &beside});
  for (int k = 0; k < 50; ++k) {
    b.p.x() += 1e-4;
    changed.SetSection(Scaled(Cable().section, 1 + 0.01 * k));
    alone.SetSection(Scaled(Cable().section, 1 + 0.01 * k));
    plain.Step(1e-3, {{&a, &b, nullptr}, {&a, &b, nullptr}});
    mixed.Step(1e-3, {{&a, &b, nullptr}, {&a, &b, nullptr}});
    ASSERT_TRUE(alone.Step(1e-3, a, b).converged);
  }
  constexpr double kConverged = 1e-9;  // [m], between Newton's last corrections
  for (int i = 0; i <= 20; ++i) {
    EXPECT_EQ(beside.pose(i).p, first.pose(i).p);
    EXPECT_LT((changed.pose(i).p - alone.pose(i).p).norm(), kConverged);
  }
  EXPECT_GT((changed.pose(10).p - first.pose(10).p).norm(), 1e-7);
}

TEST(SectionChange, ToTheSameChangesNoBit) {
  Rod plain = Arc(3), set = Arc(3);
  const Pose a = plain.pose(0);
  Pose b = plain.pose(20);
  for (int k = 0; k < 20; ++k) {
    b.p.x() += 1e-4;
    set.SetSection(Cable().section);
    ASSERT_TRUE(plain.Step(1e-3, a, b).converged);
    ASSERT_TRUE(set.Step(1e-3, a, b).converged);
  }
  for (int i = 0; i <= 20; ++i) EXPECT_EQ(plain.pose(i).p, set.pose(i).p);
}

}  // namespace
}  // namespace cosserat_cable::rod
