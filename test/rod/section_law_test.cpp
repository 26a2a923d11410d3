// Section laws that are not linear over a step: what holds for all of them.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/bending_friction.h"
#include "cosserat_cable/rod/bending_softening.h"
#include "cosserat_cable/rod/linear_section.h"
#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/point_loads.h"
#include "cosserat_cable/rod/rod_batch.h"
#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Positive definite, every component coupled to every other.
SectionMatrix FullMatrix() {
  SectionMatrix a;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) a(i, j) = std::sin(1.0 + i + 6 * j);
  const SectionVector scale = (SectionVector() << 8, 8, 8, 0.04, 0.04, 0.04).finished();
  const SectionMatrix full = scale.asDiagonal() * (a * a.transpose()) * scale.asDiagonal();
  return 0.5 * (full + full.transpose());
}

struct Case {
  const char* name;
  std::shared_ptr<const SectionLaw> law;
};
std::vector<Case> Laws() {
  return {{"full matrix", std::make_shared<LinearSection>(FullMatrix())},
          {"softening", std::make_shared<BendingSoftening>(0.02, -0.8, 3.0)},
          {"stiffening", std::make_shared<BendingSoftening>(0.02, 5.0, 3.0)},
          {"friction", std::make_shared<BendingFriction>(0.01, 2.0, 0.7)},
          {"friction from zero on", std::make_shared<BendingFriction>(0.01, 2.0, 1.0)},
          {"one slider", std::make_shared<BendingFriction>(0.01, 2.0, 0.0)}};
}

ElementStrain StrainOf(const SectionVector& v) {
  return {v.head<3>(), Vector3d::Zero(), v.tail<3>(), Vector3d::Zero()};
}

TEST(SectionLawTest, StressIsThePotentialsGradientAndTheTangentItsDerivative) {
  constexpr double kStep = 1e-6;
  // Central differences: rounding 1e-16/1e-6, and the square of the step by the law's curvature.
  constexpr double kRelative = 1e-7;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto strain = [&] {
    SectionVector v;
    for (int k = 0; k < 6; ++k) v[k] = (k < 3 ? 0.01 : 5) * number(random);
    return v;
  };
  for (const auto& [name, prototype] : Laws())
    for (int round = 0; round < 20; ++round) {
      const auto law = prototype->Clone();
      law->Reset(2);
      law->BeginStep(1e-3);
      for (int before = round % 3; before > 0; --before) law->Commit(1, StrainOf(strain()));
      const SectionVector at = strain();
      SectionResponse here;
      law->Evaluate(1, StrainOf(at), 0, &here);
      EXPECT_EQ(here.tangent, here.tangent.transpose()) << name;
      for (int k = 0; k < 6; ++k) {
        SectionVector step = SectionVector::Zero();
        step[k] = kStep;
        SectionResponse up, down;
        law->Evaluate(1, StrainOf(at + step), 0, &up);
        law->Evaluate(1, StrainOf(at - step), 0, &down);
        EXPECT_LT(((up.stress - down.stress) / (2 * kStep) - here.tangent.col(k)).norm(),
                  kRelative * std::max(1.0, here.tangent.norm()))
            << name << " " << k;
        const double slope =
            (law->Potential(1, StrainOf(at + step)) - law->Potential(1, StrainOf(at - step))) /
            (2 * kStep);
        EXPECT_NEAR(slope, here.stress[k], kRelative * std::max(1.0, here.stress.norm()))
            << name << " " << k;
      }
    }
}

TEST(SectionLawTest, AStepsPotentialIsWhatItStoresAndDissipates) {
  constexpr double kRounding = 1e-13;
  for (const auto& [name, prototype] : Laws()) {
    const auto law = prototype->Clone();
    law->Reset(1);
    for (const Vector3d& kappa :
         {Vector3d(1, 0.5, 2), Vector3d(5, -3, 0), Vector3d(4, -3, 1), Vector3d(-2, 2, -1)}) {
      const ElementStrain strain = {{0.01, 0, -0.01}, {0, 0, 0}, kappa, {0, 0, 0}};
      const double potential = law->Potential(0, strain), lost = law->Commit(0, strain);
      EXPECT_GE(lost, 0) << name;
      EXPECT_NEAR(potential, law->Energy(0, strain) + lost, kRounding) << name;
      SectionResponse after;
      law->Evaluate(0, strain, 0, &after);
      EXPECT_NEAR(law->Commit(0, strain), 0, kRounding) << name;  // and nothing more while it stays
      SectionResponse again;
      law->Evaluate(0, strain, 0, &again);
      EXPECT_LT((after.stress - again.stress).norm(), kRounding) << name;
    }
  }
}

/// The same as a diagonal LinearSection, by the path of the laws that are linear over a step.
class ElasticBranch : public SectionBranch {
 public:
  explicit ElasticBranch(const SectionValue& stiffness) : stiffness_(stiffness) {}
  std::unique_ptr<SectionBranch> Clone() const override {
    return std::make_unique<ElasticBranch>(*this);
  }
  void ExchangeState(StateArchive*) override {}
  void SetElements(int) override {}
  void BeginStep(double) override {}
  SectionValue StepStiffness() const override { return stiffness_; }
  SectionValue Offset(int) const override { return {}; }
  void Commit(int, const ElementStrain&) override {}
  void Rest(int, const ElementStrain&) override {}
  SectionValue StaticStiffness() const override { return stiffness_; }
  double Energy(int) const override { return 0; }
  double DissipationRate(int) const override { return 0; }
  std::vector<Relaxation> Relaxations() const override { return {}; }

 private:
  SectionValue stiffness_;
};

struct Twins {
  RodModel branch, law;
};
/// A rod with a diagonal stiffness more, by either path.
Twins MakeTwins(int elements, bool with_joint) {
  RodModel model = RoundCable(0.3, 0.008, 0.1, 0.01, 0.008, 1e-4, 1e-4, elements);
  model.gravity = {1, -9, 2};
  if (with_joint)
    model.joints.push_back({0.3 * (elements / 3) / elements,
                            Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 0).normalized()))});
  SectionValue more;
  more.F = {20, 30, 400};
  more.M = {0.004, 0.007, 0.005};
  SectionMatrix matrix = SectionMatrix::Zero();
  matrix.diagonal() << more.F, more.M;
  Twins twins{model, model};
  twins.branch.branches.push_back(std::make_shared<ElasticBranch>(more));
  twins.law.laws.push_back(std::make_shared<LinearSection>(matrix));
  return twins;
}

constexpr double kDt = 1e-3;

Pose Shaken(const Pose& clamp, int step) {
  Pose shaken = clamp;
  const double f = std::pow(1 - std::cos(0.1 * step), 2);
  shaken.p += f * Vector3d(0.01, 0.005, -0.004);
  shaken.q = shaken.q * Quaterniond(Eigen::AngleAxisd(0.1 * f, Vector3d(1, 1, 1).normalized()));
  return shaken;
}

double Apart(const Rod& one, const Rod& two) {
  double apart = 0;
  for (int i = 0; i <= one.elements(); ++i)
    apart = std::max(apart, (one.pose(i).p - two.pose(i).p).norm());
  return apart;
}

TEST(SectionLawTest, ALinearLawIsALinearBranch) {
  // Newton stops at 1e-9 of the length in each step; over 60 of them.
  constexpr double kClose = 2e-9, kMoment = 1e-7;
  for (const bool with_joint : {false, true})
    for (const int elements : {1, 3, 7, 20}) {
      if (with_joint && elements < 7) continue;
      const Twins twins = MakeTwins(elements, with_joint);
      Rod one(twins.branch), two(twins.law);
      const Pose a = Facing({0, 0, 0}, {0, 0, 1}), b = Facing({0.1, 0.05, 0.2}, {0, 1, 1});
      for (Rod* rod : {&one, &two}) {
        rod->SetConfiguration(BowedShape(a, b, 0.3, elements, rod->model().gravity));
        ASSERT_TRUE(rod->Equilibrate().converged) << elements;
      }
      EXPECT_LT(Apart(one, two), kClose) << elements;
      if (elements > 2) {
        const auto modes1 = FindModes(one, 3), modes2 = FindModes(two, 3);
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR(modes1[k].w, modes2[k].w, 1e-7 * modes1[k].w) << elements;
          EXPECT_NEAR(modes1[k].bending, modes2[k].bending, 1e-6) << elements;
        }
      }
      for (int step = 1; step <= 60; ++step) {
        const SolveReport report1 = one.Step(kDt, a, Shaken(b, step));
        const SolveReport report2 = two.Step(kDt, a, Shaken(b, step));
        ASSERT_TRUE(report1.converged && report2.converged) << elements << " " << step;
        // The tangent is as good.
        EXPECT_LE(std::abs(report1.iterations - report2.iterations), 1) << step;
      }
      EXPECT_LT(Apart(one, two), kClose) << elements;
      EXPECT_LT((one.reaction_b().moment - two.reaction_b().moment).norm(), kMoment);
      EXPECT_LT((one.moment(0) - two.moment(0)).norm(), kMoment);
    }
}

TEST(SectionLawTest, ALinearLawIsALinearBranchInABatch) {
  constexpr double kClose = 2e-9;
  for (const int count : {3, 7}) {
    const Twins twins = MakeTwins(12, false);
    const Pose a = Facing({0, 0, 0}, {0, 0, 1}), b = Facing({0.1, 0.05, 0.2}, {0, 1, 1});
    std::vector<Rod> rods;
    for (int l = 0; l < count; ++l) {
      rods.emplace_back(l % 2 ? twins.law : twins.branch);
      rods.back().SetConfiguration(BowedShape(a, b, 0.3, 12, twins.law.gravity));
      ASSERT_TRUE(rods.back().Equilibrate().converged);
    }
    std::vector<Rod*> pointers;
    for (Rod& rod : rods) pointers.push_back(&rod);
    RodBatch batch(pointers);
    for (int step = 1; step <= 60; ++step) {
      const Pose moved = Shaken(b, step);
      for (const SolveReport& report :
           batch.Step(kDt, std::vector<RodDrive>(count, {&a, &moved, nullptr})))
        ASSERT_TRUE(report.converged);
    }
    for (int l = 1; l < count; ++l) EXPECT_LT(Apart(rods[0], rods[l]), kClose) << l;
  }
}

const Vector3d kMoment(0.015, 0.025, 0.005);  // at the tip [N m]

/// A cantilever along z with a law, bent by a follower moment at its tip.
struct BentCantilever {
  static constexpr double kLength = 0.3;
  explicit BentCantilever(std::shared_ptr<const SectionLaw> law, int elements = 12)
      : model(RoundCable(kLength, 0.008, 0.1, 0.02, 0.015, 1e-5, 1e-5, elements)) {
    model.gravity.setZero();
    model.b = EndModel::Free();
    if (law) model.laws.push_back(std::move(law));
  }
  Rod Bent(const Vector3d& moment) const {
    Rod rod(model);
    rod.SetConfiguration(StraightShape(Pose{}, kLength, model.elements));
    PointLoads load(kLength, {{kLength, Vector3d::Zero(), moment}});
    load.loads[0].follower = true;
    EXPECT_TRUE(rod.Equilibrate(&load).converged);
    return rod;
  }
  RodModel model;
};

TEST(SectionLawTest, ForgetsAStepThatFailed) {
  for (const auto& [name, law] : Laws()) {
    Rod rod = BentCantilever(law).Bent(kMoment);
    const Pose clamp;
    for (int step = 0; step < 20; ++step) ASSERT_TRUE(rod.Step(kDt, clamp, clamp).converged);
    Rod spared(rod);
    Pose nowhere;
    nowhere.p.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(rod.Step(kDt, nowhere, clamp).converged);
    for (int step = 0; step < 20; ++step) {
      ASSERT_TRUE(rod.Step(kDt, clamp, clamp).converged);
      ASSERT_TRUE(spared.Step(kDt, clamp, clamp).converged);
    }
    for (int i = 0; i <= rod.elements(); ++i) EXPECT_EQ(rod.pose(i).p, spared.pose(i).p) << name;
    EXPECT_EQ(rod.energy_balance().dissipated, spared.energy_balance().dissipated) << name;
  }
}

TEST(SectionLawTest, EnergyIsBalancedInAFreeDecay) {
  // The release at once, which no step resolves, costs the plain rod's account as much. The rest is
  // second order in the step, and friction's kinks.
  constexpr double kRelease = 5e-3, kRelative = 1e-3;
  std::vector<Case> cases = Laws();
  cases.push_back({"plain", nullptr});
  for (const auto& [name, law] : cases) {
    const BentCantilever cantilever(law);
    Rod rod = cantilever.Bent(kMoment);
    const double stored = rod.elastic_energy();
    const Pose clamp;
    double largest = 0;
    for (int step = 0; step < 1000; ++step) {
      ASSERT_TRUE(rod.Step(2e-4, clamp, clamp).converged) << name;
      largest = std::max(largest, std::abs(rod.energy_balance().Residual()));
    }
    EXPECT_LT(largest, (kRelease + kRelative) * stored) << name;
    EXPECT_GT(rod.energy_balance().dissipated, 0.01 * stored) << name;
  }
}

TEST(SectionLawTest, ARestUnderALoadStaysARest) {
  constexpr double kDrift = 1e-8;  // [m], of Newton's last corrections in 100 steps
  for (const auto& [name, law] : Laws()) {
    const BentCantilever cantilever(law);
    Rod rod = cantilever.Bent(kMoment);
    PointLoads load(BentCantilever::kLength,
                    {{BentCantilever::kLength, Vector3d::Zero(), kMoment}});
    load.loads[0].follower = true;
    const Vector3d tip = rod.pose(rod.elements()).p;
    for (int step = 0; step < 100; ++step)
      ASSERT_TRUE(rod.Step(kDt, Pose{}, Pose{}, &load).converged) << name;
    EXPECT_LT((rod.pose(rod.elements()).p - tip).norm(), kDrift) << name;
  }
}

}  // namespace
}  // namespace cosserat_cable::rod
