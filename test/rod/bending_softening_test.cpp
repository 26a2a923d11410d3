// A bending stiffness that changes with the curvature, against closed forms.
#include "cosserat_cable/rod/bending_softening.h"

#include <gtest/gtest.h>

#include "cosserat_cable/rod/point_loads.h"
#include "rod/ringing.h"
#include "rod/rod_cases.h"
#include "tools/root.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 0.3, kEI = 0.02, kCurvature = 3;

RodModel Cantilever(double change, int elements) {
  RodModel model = RoundCable(kLength, 0.008, 0.1, kEI, 0.015, 0, 0, elements);
  model.gravity.setZero();
  model.b = EndModel::Free();
  if (change != 0)
    model.laws.push_back(std::make_shared<BendingSoftening>(kEI, change, kCurvature));
  return model;
}

Rod Bent(const RodModel& model, const Vector3d& moment) {
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, kLength, model.elements));
  PointLoads load(kLength, {{kLength, Vector3d::Zero(), moment}});
  load.loads[0].follower = true;
  EXPECT_TRUE(rod.Equilibrate(&load).converged);
  return rod;
}

TEST(BendingSofteningTest, MomentAndCurvatureInPureBending) {
  constexpr double kRelative = 1e-8;     // Newton's last correction
  constexpr double kOfCurvature = 1e-7;  // where the moment's slope is a tenth of EI
  for (const double change : {-0.8, -0.3, 2.0})
    for (const double moment : {0.01, 0.03, 0.05}) {
      const Rod rod = Bent(Cantilever(change, 12), {0.28 * moment, -0.96 * moment, 0});
      for (const int e : {0, 6, 11}) {
        const double kappa = rod.curvature(e).norm(), square = kappa * kappa;
        EXPECT_NEAR(kEI * kappa * (1 + change * square / (square + kCurvature * kCurvature)),
                    moment, kRelative * moment);
        EXPECT_NEAR(rod.curvature(e).x() / kappa, 0.28, kRelative);
        if (change != -0.8 || e != 6) continue;
        const double expected = Root(
            [&](double k) {
              return kEI * k * (1 + change * k * k / (k * k + kCurvature * kCurvature)) - moment;
            },
            0, 100);
        Validate(
            {"Causes",
             "nonlinear_stiffness: curvature under " + Shown(moment) + " N m, change -0.8 [1/m]",
             "M = EI k (1 + x k^2/(k^2 + c^2))", expected, kappa, kOfCurvature * expected, 12});
      }
    }
}

constexpr int kElements = 20;
constexpr double kDt = 2e-4;

/// Lowest frequency of a cantilever that swings with the curvature `kappa` at its root.
double Frequency(double change, double kappa) {
  RodModel model = Cantilever(0, kElements);
  // At the first mode's shape, from which it stays near: released at rest from there.
  std::vector<Pose> shape = {Pose{}};
  const double h = kLength / model.elements;
  constexpr double kMu = 1.8751040687;
  const auto curvature = [&](double x) {
    const double sigma = (std::cosh(kMu) + std::cos(kMu)) / (std::sinh(kMu) + std::sin(kMu));
    return 0.5 * kappa *
           (std::cosh(kMu * x) + std::cos(kMu * x) -
            sigma * (std::sinh(kMu * x) + std::sin(kMu * x)));
  };
  for (int e = 0; e < model.elements; ++e) {
    const double turn = h * curvature((e + 0.5) / model.elements);
    const Eigen::Quaterniond half(Eigen::AngleAxisd(0.5 * turn, Vector3d::UnitX()));
    const Pose& from = shape.back();
    shape.push_back({from.p + h * (from.q * half * Vector3d::UnitZ()), from.q * half * half});
  }
  if (change != 0)
    model.laws.push_back(std::make_shared<BendingSoftening>(kEI, change, kCurvature));
  Rod rod(model);
  rod.SetConfiguration(shape);
  std::vector<double> tip;
  for (int k = 0; k < 2500; ++k) {
    EXPECT_TRUE(rod.Step(kDt, Pose{}, Pose{}).converged);
    tip.push_back(rod.pose(model.elements).p.y());
  }
  return Listen(tip, kDt).Omega;
}

TEST(BendingSofteningTest, FrequencyFollowsTheAmplitude) {
  // One mode of curvature A psi(s): by harmonic balance, for A small beside c, w^2 changes by
  // x (3/4) (A/c)^2 int psi^4/int psi^2, relative.
  constexpr double kPart = 0.05;  // of the shift: higher orders in A/c and other modes
  constexpr double kMu = 1.8751040687;
  const double sigma = (std::cosh(kMu) + std::cos(kMu)) / (std::sinh(kMu) + std::sin(kMu));
  double square = 0, fourth = 0;
  for (int k = 0; k < 1000; ++k) {
    const double x = kMu * (k + 0.5) / 1000;
    const double psi = 0.5 * (std::cosh(x) + std::cos(x) - sigma * (std::sinh(x) + std::sin(x)));
    square += psi * psi;
    fourth += std::pow(psi, 4);
  }
  constexpr double kA = 0.3;
  const double linear = Frequency(0, kA);
  for (const double change : {-0.8, 3.0}) {
    const double ratio = Frequency(change, kA) / linear;
    const double shift = change * 0.75 * std::pow(kA / kCurvature, 2) * fourth / square;
    Validate(
        {"Causes", "nonlinear_stiffness: shift of w^2 by the amplitude, change " + Shown(change),
         "harmonic balance", shift, ratio * ratio - 1, kPart * std::abs(shift), kElements, kDt});
  }
}

}  // namespace
}  // namespace cosserat_cable::rod
