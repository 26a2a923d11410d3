// Rods whose states stay in the lanes that step them: whoever asks, changes or ends them meanwhile
// sees rods as if they were by themselves. And what solving in float may not change.
#include <gtest/gtest.h>

#include <memory>

#include "cosserat_cable/rod/rod_batch.h"
#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

constexpr double kDt = 1e-3;
constexpr int kElements = 40;
constexpr int kEight = 8;
const Pose kA;
const Pose kB{{0.1, 0, 0}, Eigen::Quaterniond(0, 0, 1, 0)};

/// `stiffer`: in stretch and shear than a round cable of this bending stiffness is.
Rod Arch(double stiffer = 1) {
  RodModel model = RoundCable(0.2, 0.008, 0.15, 0.008, 0.006, 1e-4, 5e-5, kElements);
  model.section.C_F *= stiffer;
  model.section.V_F *= std::sqrt(stiffer);
  Rod rod(model);
  rod.SetConfiguration(BowedShape(kA, kB, model.length, kElements, model.gravity));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

Pose Swept(Pose clamp, int step) {
  const double t = step * kDt;
  clamp.p.x() += 1.5e-3 * std::sin(2 * M_PI * (10 + 2 * t) * t);  // 10 to 38 Hz in 7 s
  return clamp;
}

std::vector<Rod*> PointersTo(std::vector<Rod>* rods) {
  std::vector<Rod*> pointers;
  for (Rod& rod : *rods) pointers.push_back(&rod);
  return pointers;
}

void Step(RodBatch* batch, int rods, int step) {
  const Pose a = Swept(kA, step), b = Swept(kB, step);
  for (const SolveReport& report : batch->Step(kDt, std::vector<RodDrive>(rods, {&a, &b, nullptr})))
    ASSERT_TRUE(report.converged) << step;
}

void StepAlone(Rod* rod, int step) {
  ASSERT_TRUE(rod->Step(kDt, Swept(kA, step), Swept(kB, step)).converged) << step;
}

/// Largest distance between the nodes of two rods [m].
double Apart(const Rod& one, const Rod& other) {
  double apart = 0;
  for (int i = 0; i <= one.elements(); ++i)
    apart = std::max(apart, (one.pose(i).p - other.pose(i).p).norm());
  return apart;
}

// Of rods that are stepped in lanes and by themselves [m]: the promised 1e-6 mm.
constexpr double kAsOne = 1e-9;

TEST(RodHomeTest, EightFollowTheWholeSweepAsOneDoes) {
  Rod alone = Arch();
  std::vector<Rod> eight(kEight, alone);
  RodBatch batch(PointersTo(&eight));
  double apart = 0;
  for (int step = 1; step <= 7000; ++step) {
    StepAlone(&alone, step);
    Step(&batch, kEight, step);
    if (step % 50 == 0) apart = std::max(apart, Apart(alone, eight[5]));
  }
  EXPECT_LT(apart, kAsOne);
}

TEST(RodHomeTest, StiffRodsNeedMoreThanFloatAndGetIt) {
  // An element's stiffness in stretch is up to 4e8 times that of the arch in bending: beyond the
  // digits of a float.
  for (const double stiffer : {1e2, 1e4}) {
    Rod alone = Arch(stiffer);
    std::vector<Rod> eight(kEight, alone);
    RodBatch batch(PointersTo(&eight));
    for (int step = 1; step <= 100; ++step) {
      StepAlone(&alone, step);
      Step(&batch, kEight, step);
    }
    EXPECT_LT(Apart(alone, eight[3]), kAsOne) << stiffer;
  }
}

TEST(RodHomeTest, LookingChangesNothing) {
  std::vector<Rod> seen(3, Arch()), unseen = seen;
  RodBatch batch_seen(PointersTo(&seen)), batch_unseen(PointersTo(&unseen));
  for (int step = 1; step <= 40; ++step) {
    Step(&batch_seen, 3, step);
    Step(&batch_unseen, 3, step);
    EXPECT_GT(seen[1].kinetic_energy() + seen[1].energy_balance().dissipated, 0);
    EXPECT_GT(seen[2].moment(3).norm(), 0);
  }
  for (int k = 0; k < 3; ++k) EXPECT_EQ(Apart(seen[k], unseen[k]), 0);
}

TEST(RodHomeTest, ForcesAndEnergiesAreThoseOfARodByItself) {
  constexpr double kRelative = 1e-6;  // differences of positions, of 1e-9 of them, times stiffness
  Rod alone = Arch();
  std::vector<Rod> three(3, alone);
  RodBatch batch(PointersTo(&three));
  for (int step = 1; step <= 60; ++step) {
    StepAlone(&alone, step);
    Step(&batch, 3, step);
  }
  const Rod& rod = three[2];
  const double force = alone.reaction_a().force.norm(), moment = alone.reaction_a().moment.norm();
  EXPECT_LT((rod.reaction_a().force - alone.reaction_a().force).norm(), kRelative * force);
  for (int e = 0; e < kElements; ++e) {
    EXPECT_LT((rod.force(e) - alone.force(e)).norm(), kRelative * force) << e;
    EXPECT_LT((rod.moment(e) - alone.moment(e)).norm(), kRelative * moment) << e;
  }
  const EnergyBalance one = alone.energy_balance(), other = rod.energy_balance();
  EXPECT_NEAR(other.work_ends, one.work_ends, kRelative * std::abs(one.work_ends));
  EXPECT_NEAR(other.dissipated, one.dissipated, kRelative * one.dissipated);
  EXPECT_NEAR(rod.elastic_energy(), alone.elastic_energy(), kRelative * alone.elastic_energy());
}

TEST(RodHomeTest, WhatIsChangedBetweenStepsGoesOnFromThere) {
  Rod alone = Arch();
  std::vector<Rod> three(3, alone);
  RodBatch batch(PointersTo(&three));
  for (int step = 1; step <= 60; ++step) {
    if (step == 20) {
      Motion wind;
      wind.v.y() = 0.1;
      alone.AddRigidMotion(wind);
      three[1].AddRigidMotion(wind);
    }
    StepAlone(&alone, step);
    Step(&batch, 3, step);
    if (step == 40) {  // one step by itself, in another's turn
      StepAlone(&alone, ++step);
      StepAlone(&three[1], step);
      StepAlone(&three[0], step);
      StepAlone(&three[2], step);
    }
  }
  EXPECT_LT(Apart(alone, three[1]), kAsOne);
  EXPECT_GT(Apart(alone, three[0]), 1e-6);  // the wind did something
}

TEST(RodHomeTest, RodsAndBatchesMayEndInAnyOrder) {
  Rod alone = Arch();
  auto rods = std::make_unique<std::vector<Rod>>(3, alone);
  {
    RodBatch first(PointersTo(rods.get()));
    for (int step = 1; step <= 10; ++step) {
      StepAlone(&alone, step);
      Step(&first, 3, step);
    }
    EXPECT_LT(Apart(alone, Rod((*rods)[0])), kAsOne);  // a copy has the state as well
  }
  RodBatch second(PointersTo(rods.get()));
  for (int step = 11; step <= 20; ++step) {
    StepAlone(&alone, step);
    Step(&second, 3, step);
  }
  EXPECT_LT(Apart(alone, (*rods)[2]), kAsOne);
  rods.reset();
}

}  // namespace
}  // namespace cosserat_cable::rod
