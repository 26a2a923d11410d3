// Maxwell branches beside the Kelvin-Voigt element, against their closed forms.
#include <gtest/gtest.h>

#include <complex>

#include "cosserat_cable/rod/maxwell.h"
#include "cosserat_cable/rod/point_loads.h"
#include "rod/rod_cases.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;
using Complex = std::complex<double>;

constexpr double kLength = 0.02, kGJ = 0.009, kEta = 1e-5;
constexpr int kElements = 8;

struct Branch {
  double GJ, tau;
};

RodModel ShortRod(const std::vector<Branch>& branches) {
  // Nearly massless: its own torsional waves are far above 100 Hz.
  RodModel model = RoundCable(kLength, 0.004, 0.001, 0.012, kGJ, kEta, kEta, kElements);
  model.gravity.setZero();
  for (const Branch& branch : branches) {
    SectionValue stiffness;
    stiffness.M.z() = branch.GJ;
    model.branches.push_back(std::make_shared<MaxwellBranch>(stiffness, branch.tau));
  }
  return model;
}

Pose Twisted(double angle) {
  return {{0, 0, kLength}, Eigen::Quaterniond(AngleAxisd(angle, Vector3d::UnitZ()))};
}

/// Torsional modulus from the moment that twists one end to and fro.
Complex MeasureModulus(const RodModel& model, double frequency) {
  constexpr int kPerPeriod = 200, kPeriods = 6;
  constexpr double kAngle = 0.05;
  const double w = 2 * M_PI * frequency, dt = 1 / (frequency * kPerPeriod);
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, kLength, kElements));
  const Pose still;
  Complex moment = 0, angle = 0;
  for (int k = 1; k <= kPerPeriod * kPeriods; ++k) {
    const double t = k * dt;
    const double phi = kAngle * std::sin(w * t);
    EXPECT_TRUE(rod.Step(dt, still, Twisted(phi)).converged);
    if (k <= kPerPeriod * (kPeriods - 1)) continue;  // settled: the slowest branch is faster
    const Complex wave = std::exp(Complex(0, -w * t));
    moment += rod.reaction_b().moment.z() * wave;
    angle += phi * wave;
  }
  return moment / angle * kLength;
}

TEST(SectionBranchTest, ComplexModulusIsThatOfAGeneralisedMaxwellSolid) {
  // 200 steps a period: (w dt)^2/12 = 8e-5.
  constexpr double kRelative = 2e-3;
  const std::vector<std::vector<Branch>> solids = {
      {}, {{0.004, 0.01}}, {{0.003, 0.1}, {0.002, 0.01}, {0.005, 0.001}}};
  for (const auto& branches : solids)
    for (double frequency : {0.5, 3.0, 20.0, 100.0}) {
      const Complex s(0, 2 * M_PI * frequency);
      Complex expected = kGJ + s * kEta;
      for (const Branch& b : branches) expected += b.GJ * s * b.tau / (1.0 + s * b.tau);
      const Complex measured = MeasureModulus(ShortRod(branches), frequency);
      EXPECT_LT(std::abs(measured - expected), kRelative * std::abs(expected))
          << branches.size() << " branches at " << frequency << " Hz";
      if (frequency != 3 && frequency != 100) continue;
      const std::string section = branches.empty() ? "Vibration" : "Causes";
      const std::string name = (branches.empty()       ? "section of Kelvin and Voigt at "
                                : branches.size() == 1 ? "maxwell: one branch at "
                                                       : "maxwell: three branches at ") +
                               Shown(frequency) + " Hz, ";
      const char* source = "generalised Maxwell solid, complex modulus";
      const double within = kRelative * std::abs(expected), dt = 1 / (200 * frequency);
      Validate({section, name + "storage modulus [N m^2]", source, expected.real(), measured.real(),
                within, kElements, dt});
      Validate({section, name + "loss modulus [N m^2]", source, expected.imag(), measured.imag(),
                within, kElements, dt});
    }
}

TEST(SectionBranchTest, MomentRelaxesAfterASuddenTwist) {
  // Held at once, the branch's share of the moment decays with exp(-t/tau).
  constexpr double kRelative = 1e-3;
  constexpr Branch kBranch = {0.004, 0.05};
  constexpr double kAngle = 0.02, kDt = 1e-4;
  RodModel model = ShortRod({kBranch});
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, kLength, kElements));
  const Pose still;
  // Over 20 steps; the ramp's middle is the time from which the decay counts.
  constexpr int kRamp = 20;
  for (int k = 1; k <= 1000; ++k) {
    const double share = std::min(1.0, static_cast<double>(k) / kRamp);
    ASSERT_TRUE(rod.Step(kDt, still, Twisted(kAngle * share)).converged);
    if (k < 200 || k % 100 != 0) continue;
    const double since = k * kDt - 0.5 * kRamp * kDt;
    const double expected = (kGJ + kBranch.GJ * std::exp(-since / kBranch.tau)) * kAngle / kLength;
    EXPECT_NEAR(rod.reaction_b().moment.z(), expected, kRelative * expected) << k;
  }
}

TEST(SectionBranchTest, CreepsBackAfterRelease) {
  // A standard linear solid, held twisted until relaxed, then let go. Without a moment the branch,
  // which has taken the twist as its set strain, balances GJ: it springs back to the share
  // GJ1/(GJ + GJ1) of the twist, and from there creeps home with the time constant
  // tau (GJ + GJ1)/GJ.
  constexpr double kRelative = 5e-3;
  constexpr Branch kBranch = {0.006, 0.05};
  constexpr double kAngle = 0.1, kDt = 1e-4;
  RodModel model = ShortRod({kBranch});
  model.section.V_M.z() = 2e-7;  // just enough that the rod does not ring after the release
  model.b = EndModel::Free();
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, kLength, kElements));
  PointLoads hold(kLength, {{kLength, Vector3d::Zero(), {0, 0, kGJ * kAngle / kLength}}});
  hold.loads[0].follower = true;
  ASSERT_TRUE(rod.Equilibrate(&hold).converged);  // fully relaxed: GJ alone carries
  const Pose still;
  const double total = kGJ + kBranch.GJ;
  for (int k = 1; k <= 2000; ++k) {
    ASSERT_TRUE(rod.Step(kDt, still, still).converged);
    if (k < 200 || k % 200 != 0) continue;
    const double expected =
        kAngle * kBranch.GJ / total * std::exp(-k * kDt * kGJ / (total * kBranch.tau));
    const Eigen::Quaterniond q = rod.pose(kElements).q;
    EXPECT_NEAR(2 * std::atan2(q.z(), q.w()), expected, kRelative * expected) << k;
    if (k == 1000)
      Validate({"Causes", "maxwell: creep, twist 0.1 s after release [rad]", "closed form",
                expected, 2 * std::atan2(q.z(), q.w()), kRelative * expected, kElements, kDt});
  }
}

}  // namespace
}  // namespace cosserat_cable::rod
