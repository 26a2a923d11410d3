#include "cosserat_cable/cable/cable_fleet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cable/cable_cases.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

constexpr double kDt = 1e-3;
const Vector3d kGravity(0, 0, -9.81);

/// Hoses of several lengths hanging in a U over a floor that the longest touches.
CableModel Hose(int k, int elements) {
  CableModel m = RoundCableModel(0.36 + 0.02 * k, 0.01, 0.12, 0.03 + 0.01 * k, 0.028, 1e-4);
  m.elements = elements;
  return m;
}

Surroundings At(double t) {
  Surroundings s;
  s.a.X.q = Eigen::Quaterniond(0, 1, 0, 0);
  s.b.X.p = {0, 0.2, 0.01 * std::sin(100 * t)};
  s.b.v.z() = 1.0 * std::cos(100 * t);
  s.b.a.z() = -100.0 * std::sin(100 * t);
  s.obstacles.resize(1);
  return s;
}

const Body& Floor() {
  static const Body floor({Shape{{{0, 0.1, -0.24}, {1, 0, 0, 0}}, Box{{1, 1, 0.1}}}});
  return floor;
}

std::vector<CableSimulation> Settled(const std::vector<int>& elements) {
  std::vector<CableSimulation> cables;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    cables.emplace_back(Hose(static_cast<int>(k), elements[k]), std::vector<const Body*>{&Floor()},
                        kGravity);
    EXPECT_TRUE(cables.back().Settle(At(0)).ok);
  }
  return cables;
}

std::vector<CableSimulation*> Pointers(std::vector<CableSimulation>& cables) {
  std::vector<CableSimulation*> pointers;
  for (CableSimulation& cable : cables) pointers.push_back(&cable);
  return pointers;
}

TEST(CableFleetTest, StepsAsOneByOne) {
  // m; rounding only. Contact is a discontinuity of curvature, not of force, and amplifies little.
  constexpr double kTolerance = 1e-8;
  const std::vector<int> elements = {40, 40, 30, 40, 40, 40, 25};  // groups of 5, 1 and 1
  std::vector<CableSimulation> together = Settled(elements), alone = Settled(elements);
  CableFleet fleet(Pointers(together));
  double force = 0;
  for (int s = 1; s <= 300; ++s) {
    const Surroundings then = At(s * kDt);
    for (const StepOutcome& outcome :
         fleet.Step(kDt, std::vector<const Surroundings*>(elements.size(), &then)))
      ASSERT_TRUE(outcome.ok);
    for (CableSimulation& cable : alone) ASSERT_TRUE(cable.Step(kDt, then).ok);
    force += together.back().Report().contact_force;
  }
  EXPECT_GT(force, 0);  // the floor took part
  for (std::size_t k = 0; k < elements.size(); ++k)
    EXPECT_LT((together[k].Report().apex - alone[k].Report().apex).norm(), kTolerance) << k;
}

TEST(CableFleetTest, GroupsForThreadsChangeNothing) {
  const std::vector<int> elements(9, 20);
  std::vector<CableSimulation> one = Settled(elements), two = Settled(elements);
  CableFleet of_one(Pointers(one)), of_two(Pointers(two), 2);
  for (int s = 1; s <= 100; ++s) {
    const Surroundings then = At(s * kDt);
    const std::vector<const Surroundings*> thens(elements.size(), &then);
    of_one.Step(kDt, thens);
    of_two.Step(kDt, thens);
  }
  for (std::size_t k = 0; k < elements.size(); ++k)
    EXPECT_EQ(one[k].Report().apex, two[k].Report().apex) << k;
}

TEST(CableFleetTest, ALoneCableMayGoByItself) {
  const std::vector<int> elements = {20, 30, 20};
  std::vector<CableSimulation> fleet = Settled(elements), alone = Settled(elements),
                               lanes = Settled(elements);
  CableFleet mixed(Pointers(fleet), 1, LoneCable::kByItself), all_in_lanes(Pointers(lanes));
  for (int s = 1; s <= 100; ++s) {
    const Surroundings then = At(s * kDt);
    const std::vector<const Surroundings*> thens(elements.size(), &then);
    for (const StepOutcome& outcome : mixed.Step(kDt, thens)) ASSERT_TRUE(outcome.ok);
    all_in_lanes.Step(kDt, thens);
    ASSERT_TRUE(alone[1].Step(kDt, then).ok);
  }
  EXPECT_EQ(fleet[0].Report().apex, lanes[0].Report().apex);
  EXPECT_EQ(fleet[1].Report().apex, alone[1].Report().apex);
  EXPECT_EQ(fleet[2].Report().apex, lanes[2].Report().apex);
  // One that is left alone stays where it is.
  const Eigen::Vector3d before = fleet[1].Report().apex;
  const Surroundings then = At(101 * kDt);
  mixed.Step(kDt, {&then, nullptr, &then});
  EXPECT_EQ(fleet[1].Report().apex, before);
}

TEST(CableFleetTest, GroupsAreSharedOutAsFarAsTheyFillAKernel) {
  const auto sizes = [](std::size_t cables, int threads) {
    std::vector<CableSimulation> fleet;
    for (std::size_t k = 0; k < cables; ++k)
      fleet.emplace_back(Hose(0, 4), std::vector<const Body*>(), kGravity);
    const CableFleet grouped(Pointers(fleet), threads);
    std::vector<std::size_t> sizes;
    for (std::size_t g = 0; g < grouped.group_count(); ++g)
      sizes.push_back(grouped.members(g).size());
    return sizes;
  };
  using Sizes = std::vector<std::size_t>;
  EXPECT_EQ(sizes(8, 2), (Sizes{4, 4}));
  EXPECT_EQ(sizes(8, 16), (Sizes{4, 4}));
  EXPECT_EQ(sizes(3, 2), (Sizes{3}));
  EXPECT_EQ(sizes(5, 2), (Sizes{2, 3}));
}

TEST(CableFleetTest, MixesClampsThatGiveWayWithRigidOnes) {
  constexpr double kTolerance = 1e-8;  // [m] rounding only
  const auto settled = [] {
    std::vector<CableSimulation> cables;
    for (int k = 0; k < 7; ++k) {
      CableModel model = Hose(0, 40);
      if (k % 3 > 0)
        model.extensions = {
            {"clamp_compliance", {{{k % 3 == 1 ? "a.bending" : "b.torsion", 0.5}}}}};
      cables.emplace_back(model, std::vector<const Body*>{&Floor()}, kGravity);
      EXPECT_TRUE(cables.back().Settle(At(0)).ok);
    }
    return cables;
  };
  std::vector<CableSimulation> together = settled(), alone = settled();
  CableFleet fleet(Pointers(together));
  for (int s = 1; s <= 100; ++s) {
    const Surroundings then = At(s * kDt);
    for (const StepOutcome& outcome :
         fleet.Step(kDt, std::vector<const Surroundings*>(together.size(), &then)))
      ASSERT_TRUE(outcome.ok);
    for (CableSimulation& cable : alone) ASSERT_TRUE(cable.Step(kDt, then).ok);
  }
  for (std::size_t k = 0; k < together.size(); ++k)
    EXPECT_LT((together[k].Report().apex - alone[k].Report().apex).norm(), kTolerance) << k;
  EXPECT_GT((together[0].Report().apex - together[1].Report().apex).norm(), 1e-4);
}

TEST(CableFleetTest, ACableThatFailsOrRestsLeavesTheOthersAlone) {
  const std::vector<int> elements(4, 40);
  std::vector<CableSimulation> all = Settled(elements), some = Settled(elements);
  CableFleet fleet(Pointers(all)), other(Pointers(some));
  Surroundings bad = At(kDt);
  bad.a.X.p.y() = std::numeric_limits<double>::quiet_NaN();
  const Vector3d before = some[1].Report().apex;
  for (int s = 1; s <= 50; ++s) {
    const Surroundings then = At(s * kDt);
    fleet.Step(kDt, {&then, &then, &then, &then});
    const auto outcomes = other.Step(kDt, {&then, &bad, nullptr, &then});
    EXPECT_FALSE(outcomes[1].ok);
    EXPECT_TRUE(outcomes[0].ok);
  }
  EXPECT_EQ(all[0].Report().apex, some[0].Report().apex);
  EXPECT_EQ(all[3].Report().apex, some[3].Report().apex);
  EXPECT_EQ(some[1].Report().apex, before);
}

}  // namespace
}  // namespace cosserat_cable
