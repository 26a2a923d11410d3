// Loads: several at once, those of the model, time, and what they dissipate.
#include <gtest/gtest.h>

#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/point_loads.h"
#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 0.2, kDt = 1e-3;
const Pose kClamp;

RodModel Cantilever() {
  RodModel model = RoundCable(kLength, 0.008, 0.09, 0.012, 0.009, 1e-5, 5e-6, 20);
  model.b = EndModel::Free();
  return model;
}

Rod Straight(const RodModel& model) {
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, model.length, model.elements));
  return rod;
}

std::vector<double> TipOf(Rod rod, const Load* load) {
  EXPECT_TRUE(rod.Equilibrate(load).converged);
  std::vector<double> all;
  for (int k = 0; k < 40; ++k) {
    EXPECT_TRUE(rod.Step(kDt, kClamp, kClamp, k < 20 ? load : nullptr).converged);
    const Vec3<double> tip = rod.position(rod.elements());
    all.insert(all.end(), {tip.x, tip.y, tip.z});
  }
  return all;
}

const PointLoad kFirst{0.13, {0.1, 0, 0}}, kSecond{0.2, {0, -0.05, 0}};

TEST(LoadsTest, SeveralActLikeOneWithAllForces) {
  const PointLoads one(kLength, {kFirst}), other(kLength, {kSecond}),
      both(kLength, {kFirst, kSecond});
  EXPECT_EQ(TipOf(Straight(Cantilever()), &both),
            TipOf(Straight(Cantilever()),
                  std::make_unique<LoadSum>(std::vector<const Load*>{&one, &other}).get()));
}

TEST(LoadsTest, TheModelsLoadsAlwaysAct) {
  // In statics and in steps, with a load of the step's own and without.
  RodModel model = Cantilever();
  model.loads = {std::make_shared<PointLoads>(kLength, std::vector<PointLoad>{kFirst})};
  const PointLoads first(kLength, {kFirst}), both(kLength, {kFirst, kSecond}),
      second(kLength, {kSecond});
  EXPECT_EQ(TipOf(Straight(model), nullptr).size(), TipOf(Straight(Cantilever()), &first).size());
  Rod of_model = Straight(model), given = Straight(Cantilever());
  ASSERT_TRUE(of_model.Equilibrate(&second).converged);
  ASSERT_TRUE(given.Equilibrate(&both).converged);
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(of_model.Step(kDt, kClamp, kClamp).converged);
    ASSERT_TRUE(given.Step(kDt, kClamp, kClamp, &first).converged);
    EXPECT_EQ(of_model.pose(20).p, given.pose(20).p);
  }
  Rod copy(of_model);
  ASSERT_TRUE(copy.Step(kDt, kClamp, kClamp).converged);
  ASSERT_TRUE(given.Step(kDt, kClamp, kClamp, &first).converged);
  EXPECT_EQ(copy.pose(20).p, given.pose(20).p);
}

/// A force on the tip that grows with time.
class Growing : public Load {
 public:
  void Evaluate(const Centreline& rod, LoadSink* sink) const override {
    sink->AddNodeForce(rod.elements(), {kRate * rod.time(), 0, 0}, {}, {});
  }
  double Energy(const Centreline& rod) const override {
    return -kRate * rod.time() * rod.position(rod.elements()).x;
  }
  static constexpr double kRate = 0.01;  // [N/s]
};

TEST(LoadsTest, AreToldTheTimeAtTheStepsEnd) {
  const Growing growing;
  Rod rod = Straight(Cantilever());
  rod.SetTime(5);
  ASSERT_TRUE(rod.Equilibrate(&growing).converged);
  EXPECT_NEAR(rod.reaction_a().force.x(), -5 * Growing::kRate, 1e-9);
  for (int k = 0; k < 10; ++k) ASSERT_TRUE(rod.Step(kDt, kClamp, kClamp, &growing).converged);
  EXPECT_NEAR(rod.time(), 5.01, 1e-12);
  // The forces that the clamp and the load exert are what the momentum changes by.
  Rod pushed = Straight(Cantilever());
  pushed.SetTime(5);
  ASSERT_TRUE(pushed.Equilibrate(&growing).converged);
  for (int k = 1; k <= 10; ++k) {
    const double f = Growing::kRate * (5 + k * kDt);
    const PointLoads constant(kLength, {{kLength, {f, 0, 0}}});
    ASSERT_TRUE(pushed.Step(kDt, kClamp, kClamp, &constant).converged);
  }
  EXPECT_LT((pushed.pose(20).p - rod.pose(20).p).norm(), 1e-12);
  EXPECT_FALSE(rod.Step(kDt, {{30, 0, 0}, {0, 1, 0, 0}}, kClamp, &growing).converged);
  EXPECT_NEAR(rod.time(), 5.01, 1e-12) << "a failed step takes no time";
}

/// -c v on every node: a dashpot to the world.
class Viscous : public Load {
 public:
  void Evaluate(const Centreline& rod, LoadSink* sink) const override {
    double lost = 0;
    for (int i = 0; i <= rod.elements(); ++i) {
      const Vec3<double> v = rod.velocity(i);
      const double c = kC;
      sink->AddNodeForce(i, -c * v, {}, {{{-c, 0, 0}, {0, -c, 0}, {0, 0, -c}}});
      lost += c * Dot(v, v);
    }
    sink->AddDissipation(lost);
  }
  double Energy(const Centreline&) const override { return 0; }
  bool ActsAtRest() const override { return false; }
  static constexpr double kC = 2e-3;  // [N s/m]
};

TEST(LoadsTest, WhatTheyDissipateIsNotTheirWork) {
  constexpr double kWithin = 1e-3;  // of the energy dissipated
  RodModel model = Cantilever();
  model.section.V_M.setZero();
  model.loads = {std::make_shared<Viscous>()};
  const PointLoads pull(kLength, {{kLength, {0.3, 0, 0}}});
  Rod rod = Straight(model), without = Straight(Cantilever());
  ASSERT_TRUE(rod.Equilibrate(&pull).converged);
  ASSERT_TRUE(without.Equilibrate(&pull).converged);
  EXPECT_EQ(rod.pose(20).p, without.pose(20).p) << "nothing at rest";
  const double before = rod.elastic_energy();
  for (int k = 0; k < 500; ++k) ASSERT_TRUE(rod.Step(kDt, kClamp, kClamp).converged);
  const EnergyBalance balance = rod.energy_balance();
  EXPECT_GT(balance.dissipated, 0.3 * before);
  EXPECT_NEAR(balance.work_loads, 0, 1e-12);
  EXPECT_LT(std::abs(balance.Residual()), kWithin * balance.dissipated);
}

TEST(LoadsTest, NodeForcesAreThoseOnThePointAtTheNode) {
  class AtNodes : public Load {
   public:
    explicit AtNodes(bool by_node) : by_node_(by_node) {}
    void Evaluate(const Centreline& rod, LoadSink* sink) const override {
      const double k = 3, c = 0.01;
      for (int i = 1; i <= rod.elements(); ++i) {
        const Vec3<double> f = -k * rod.position(i) - c * rod.velocity(i);
        const Mat3<double> K{{{-k, 0, 0}, {0, -k, 0}, {0, 0, -k}}},
            C{{{-c, 0, 0}, {0, -c, 0}, {0, 0, -c}}};
        if (by_node_)
          sink->AddNodeForce(i, f, K, C);
        else
          sink->AddForce(i - 1, 1.0, f, K, C);
      }
    }
    double Energy(const Centreline& rod) const override {
      double energy = 0;
      for (int i = 1; i <= rod.elements(); ++i)
        energy += 1.5 * Dot(rod.position(i), rod.position(i));
      return energy;
    }

   private:
    bool by_node_;
  };
  const AtNodes one(true), other(false);
  EXPECT_EQ(TipOf(Straight(Cantilever()), &one), TipOf(Straight(Cantilever()), &other));
  Rod rod = Straight(Cantilever());
  ASSERT_TRUE(rod.Equilibrate(&one).converged);
  EXPECT_EQ(FindModes(rod, 2, &one)[1].lambda, FindModes(rod, 2, &other)[1].lambda);
}

}  // namespace
}  // namespace cosserat_cable::rod
