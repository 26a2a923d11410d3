#include "cosserat_cable/rod/rod_batch.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

constexpr double kDt = 1e-3;

/// Four different arches; the second is so soft that it needs more iterations than the others.
RodModel Model(int k) {
  const double EI[] = {0.008, 0.0005, 0.02, 0.012};
  const double eta[] = {1e-4, 1e-7, 2e-4, 1.2e-5};
  return RoundCable(0.2 + 0.02 * k, 0.008, 0.15, EI[k], 0.75 * EI[k], eta[k], eta[k] / 2, 22);
}

const Pose kA;
const Pose kB{{0.1, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Vector3d::UnitY()))};

Rod Settled(int k) {
  const RodModel model = Model(k);
  Rod rod(model);
  rod.SetConfiguration(BowedShape(kA, kB, model.length, model.elements, model.gravity));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

Pose Shaken(Pose clamp, int k, double t) {
  const double w = 2 * M_PI * (10 + 5 * k), amplitude = 2e-3;
  const Vector3d axis = Vector3d(1, 0.3 * k, -0.2).normalized();
  clamp.p += amplitude * std::sin(w * t) * axis;
  return clamp;
}

/// Apex positions of the chosen arches, stepped together in this order.
std::vector<Vector3d> StepTogether(const std::vector<int>& chosen, int steps) {
  std::vector<Rod> rods;
  for (int k : chosen) rods.push_back(Settled(k));
  std::vector<Rod*> pointers;
  for (Rod& rod : rods) pointers.push_back(&rod);
  RodBatch batch(pointers);
  for (int s = 1; s <= steps; ++s) {
    std::vector<Pose> a, b;
    for (int k : chosen) {
      a.push_back(Shaken(kA, k, s * kDt));
      b.push_back(Shaken(kB, k, s * kDt));
    }
    std::vector<RodDrive> drives;
    for (std::size_t i = 0; i < chosen.size(); ++i) drives.push_back({&a[i], &b[i], nullptr});
    for (const SolveReport& report : batch.Step(kDt, drives)) EXPECT_TRUE(report.converged);
  }
  std::vector<Vector3d> apex;
  for (Rod& rod : rods) apex.push_back(rod.pose(11).p);
  return apex;
}

TEST(RodBatchTest, MatchesSingleSteps) {
  constexpr double kTolerance = 1e-9;  // m: the promised 1e-6 mm; Newton leaves 2e-9 of the length
  const std::vector<Vector3d> together = StepTogether({0, 1, 2, 3}, 300);
  for (int k = 0; k < 4; ++k) {
    Rod rod = Settled(k);
    for (int s = 1; s <= 300; ++s)
      ASSERT_TRUE(rod.Step(kDt, Shaken(kA, k, s * kDt), Shaken(kB, k, s * kDt)).converged);
    EXPECT_LT((rod.pose(11).p - together[k]).norm(), kTolerance) << k;
  }
}

/// Pushes the rod aside against springs, inside of each element.
class SpringOnNodes : public Load {
 public:
  void Evaluate(const Centreline& rod, LoadSink* sink) const override {
    const Mat3<double> k = {{{-kStiffness, 0, 0}, {0, -kStiffness, 0}, {0, 0, 0}}};
    for (int e = 0; e < rod.elements(); ++e) {
      const double xi = 0.3;
      const Vec3<double> p = (1 - xi) * rod.position(e) + xi * rod.position(e + 1);
      const Vec3<double> v = (1 - xi) * rod.velocity(e) + xi * rod.velocity(e + 1);
      sink->AddForce(e, xi, {0.2 - kStiffness * p.x, -kStiffness * p.y, -kDamping * v.z}, k,
                     {{{0, 0, 0}, {0, 0, 0}, {0, 0, -kDamping}}});
    }
  }
  double Energy(const Centreline&) const override { return 0; }

 private:
  static constexpr double kStiffness = 20, kDamping = 0.05;  // N/m, N s/m
};

TEST(RodBatchTest, MatchesSingleStepsForAnyEndsAndNumberOfElements) {
  // A single rod is solved from both ends: their nodes may be held or free, and meet anywhere.
  constexpr double kTolerance = 1e-9;  // as above
  constexpr int kSteps = 40;
  const SpringOnNodes load;
  const EndModel sprung = EndModel::Sprung({0.1, 0.2, 0.3}, {1e-4, 1e-4, 1e-4});
  const std::pair<EndModel, EndModel> ends[] = {{EndModel::Clamped(), EndModel::Free()},
                                                {EndModel::Free(), EndModel::Clamped()},
                                                {EndModel::Clamped(), EndModel::Clamped()},
                                                {EndModel::Pinned(), EndModel::Clamped()},
                                                {sprung, EndModel::Pinned()}};
  const Pose a = kA;
  for (int elements : {1, 2, 3, 8, 9})
    for (int held = 0; held < 5; ++held) {
      RodModel model = RoundCable(0.2, 0.008, 0.15, 0.008, 0.006, 1e-4, 5e-5, elements);
      model.a = ends[held].first;
      model.b = ends[held].second;
      const Pose b = {{0, 0, 0.2}, Eigen::Quaterniond::Identity()};
      Rod alone(model);
      alone.SetConfiguration(StraightShape(kA, model.length, elements));
      Rod first = alone, second = alone;
      RodBatch batch({&first, &second});
      for (int s = 0; s < kSteps; ++s) {
        ASSERT_TRUE(alone.Step(kDt, a, b, &load).converged) << elements << " " << held;
        for (const SolveReport& report : batch.Step(kDt, {{&a, &b, &load}, {&a, &b, &load}}))
          ASSERT_TRUE(report.converged);
      }
      for (int i = 0; i <= elements; ++i)
        EXPECT_LT((alone.pose(i).p - second.pose(i).p).norm(), kTolerance)
            << elements << " elements, held " << held << ", node " << i;
      // By what Newton leaves of the positions, 1e-9 of the length, an element is stretched.
      const double h = model.length / elements;
      const double force = model.section.C_F.z() / h * 1e-9 * model.length;
      EXPECT_LT((alone.reaction_a().force - second.reaction_a().force).norm(), force);
      EXPECT_LT((alone.reaction_b().moment - second.reaction_b().moment).norm(), force * h);
    }
}

TEST(RodBatchTest, ALaneDoesNotDependOnItsNeighbours) {
  const std::vector<Vector3d> all = StepTogether({0, 1, 2, 3}, 200);
  EXPECT_EQ(StepTogether({3, 1}, 200)[0], all[3]);
  EXPECT_EQ(StepTogether({0}, 200)[0], all[0]);
  EXPECT_EQ(StepTogether({2, 2, 0}, 200)[2], all[0]);
}

TEST(RodBatchTest, EightAreLikeFour) {
  constexpr double kTolerance = 1e-9;  // m, as above: other machine code may round otherwise
  const std::vector<Vector3d> four = StepTogether({0, 1, 2, 3}, 200);
  const std::vector<Vector3d> eight = StepTogether({3, 2, 1, 0, 0, 1, 2, 3}, 200);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(eight[3 - k], eight[4 + k]) << k;
    EXPECT_LT((eight[3 - k] - four[k]).norm(), kTolerance) << k;
  }
  EXPECT_EQ(StepTogether({2, 1, 0, 3, 1, 1}, 200)[2], eight[3]);
}

TEST(RodBatchTest, AFailureStaysInItsLane) {
  const std::vector<Vector3d> expected = StepTogether({0, 3}, 1);
  Rod good = Settled(0), bad = Settled(1), other = Settled(3);
  const Vector3d before = bad.pose(11).p;
  RodBatch batch({&good, &bad, &other});
  const Pose a0 = Shaken(kA, 0, kDt), b0 = Shaken(kB, 0, kDt);
  const Pose a3 = Shaken(kA, 3, kDt), b3 = Shaken(kB, 3, kDt);
  Pose nan = a0;
  nan.p.x() = std::numeric_limits<double>::quiet_NaN();
  const auto reports =
      batch.Step(kDt, {{&a0, &b0, nullptr}, {&nan, &b0, nullptr}, {&a3, &b3, nullptr}});
  EXPECT_TRUE(reports[0].converged);
  EXPECT_FALSE(reports[1].converged);
  EXPECT_TRUE(reports[2].converged);
  EXPECT_EQ(good.pose(11).p, expected[0]);
  EXPECT_EQ(other.pose(11).p, expected[1]);
  EXPECT_EQ(bad.pose(11).p, before);
}

TEST(RodBatchTest, RefusesRodsThatDoNotFitTogether) {
  RodModel model = Model(0);
  model.elements = 30;
  Rod a = Settled(0), b(model);
  EXPECT_THROW(RodBatch({&a, &b}), std::invalid_argument);
  EXPECT_THROW(RodBatch({}), std::invalid_argument);
}

}  // namespace
}  // namespace cosserat_cable::rod
