#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "rod/published_rods.h"
#include "rod/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

// An independent prototype's table for cables that reproduce the source paper's Figs 11 and 12; its
// values are good to about 1 %, and are given to three digits.
constexpr double kPrototype = 0.015;

TEST(DynamicsTest, SweptArchInPlaneMatchesTheTable) {
  const double factor[] = {1.5, 1.0, 0.5};
  const double at_3s[] = {1.60, 1.68, 1.95}, at_6s[] = {1.62, 1.68, 1.94};
  for (int k = 0; k < 3; ++k) {
    const Sweep sweep{0.0080, 0.15, 1e-4 * factor[k], Vector3d::UnitX()};
    const auto amplitude = sweep.ApexAmplitudes({3, 6});
    EXPECT_NEAR(1e3 * amplitude[0], at_3s[k], kPrototype * at_3s[k]);
    EXPECT_NEAR(1e3 * amplitude[1], at_6s[k], kPrototype * at_6s[k]);
  }
}

TEST(DynamicsTest, SweptArchOutOfPlaneMatchesTheTable) {
  const Sweep sweep{0.0205, 0.09, 1e-4, Vector3d::UnitY()};
  const auto amplitude = sweep.ApexAmplitudes({3, 6});
  EXPECT_NEAR(1e3 * amplitude[0], 2.34, kPrototype * 2.34);
  EXPECT_NEAR(1e3 * amplitude[1], 2.60, kPrototype * 2.60);
}

TEST(DynamicsTest, LightlyDampedArchResonatesWhereTheTableSays) {
  const Sweep sweep{0.0080, 0.15, 1e-5, Vector3d::UnitX()};
  std::vector<double> times;
  for (double t = 5.2; t < 6.0; t += 0.02) times.push_back(t);
  const auto amplitude = sweep.ApexAmplitudes(times);
  const auto peak = std::max_element(amplitude.begin(), amplitude.end());
  // Resonance amplitudes lose 1.6 % at dt = 1 ms; the peak is flat over a few hundredths of a
  // second.
  EXPECT_NEAR(1e3 * *peak, 6.0, 0.03 * 6.0);
  EXPECT_NEAR(times[peak - amplitude.begin()], 5.58, 0.05);
}

/// Small free bending oscillation of a cantilever in its first mode, without gravity: frequency
/// [rad/s] and damping ratio from the zeros and the extrema of the tip.
struct Decay {
  double w, zeta;
};

Decay FreeDecay(double EI, double eta_EI, double dt, int zero_count) {
  constexpr int kElements = 40;
  constexpr double kLength = 0.3, kRhoA = 0.05;
  RodModel model = RoundCable(kLength, 0.004, kRhoA, EI, EI, eta_EI, eta_EI, kElements);
  if (eta_EI == 0) model.section.V_F.setZero();
  model.gravity.setZero();
  model.b = EndModel::Free();
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, kLength, kElements));
  // A load in the shape of the mode pulls the beam into that shape. 1 mm at the tip: linear to
  // 1e-5.
  std::vector<Vec3<double>> forces;
  const double w_squared = std::pow(1.87510407, 4) * EI / (kRhoA * std::pow(kLength, 4));
  for (int i = 0; i <= kElements; ++i) {
    const double share = kLength / kElements * (i == kElements ? 0.5 : 1.0);
    forces.push_back({0.5e-3 * CantileverMode(i / 40.0) * w_squared * kRhoA * share, 0, 0});
  }
  const NodeForces pull(forces);
  EXPECT_TRUE(rod.Equilibrate(&pull).converged);
  const Pose clamp;
  std::vector<double> zeros, extrema;
  double before = 0, last = rod.pose(kElements).p.x();
  for (int k = 1; static_cast<int>(zeros.size()) < zero_count && k * dt < 20; ++k) {
    EXPECT_TRUE(rod.Step(dt, clamp, clamp).converged);
    const double x = rod.pose(kElements).p.x();
    if (last * x < 0) zeros.push_back((k - 1 + last / (last - x)) * dt);
    if (k > 1 && (last - before) * (x - last) < 0) {
      // Vertex of the parabola through three samples.
      const double curvature = before - 2 * last + x, slope = 0.5 * (x - before);
      extrema.push_back(std::abs(last - 0.5 * slope * slope / curvature));
    }
    before = last;
    last = x;
  }
  if (static_cast<int>(zeros.size()) < zero_count) {
    ADD_FAILURE() << "no oscillation";
    return {};
  }
  const double damped = M_PI * (zeros.size() - 1) / (zeros.back() - zeros.front());
  const double decrement = std::log(extrema.front() / extrema.back()) / (extrema.size() - 1);
  const double zeta = decrement / std::hypot(M_PI, decrement);
  return {damped / std::sqrt(1 - zeta * zeta), zeta};
}

TEST(DynamicsTest, CantileverHasTheFrequencyAndDampingOfItsFirstMode) {
  // Euler-Bernoulli: w = 1.87510^2 sqrt(EI/(rhoA L^4)); Kelvin-Voigt: zeta = w eta/(2 EI).
  constexpr double kFrequency = 2e-3;  // shear and rotary inertia 1e-3, (w dt)^2/12 1e-5
  constexpr double kDamping = 0.01;
  constexpr double kEI = 0.02, kEta = 2e-5;
  const double w = std::pow(1.87510, 2) * std::sqrt(kEI / (0.05 * std::pow(0.3, 4)));
  const Decay decay = FreeDecay(kEI, kEta, 5e-4, 21);
  EXPECT_NEAR(decay.w, w, kFrequency * w);
  EXPECT_NEAR(decay.zeta, w * kEta / (2 * kEI), kDamping * w * kEta / (2 * kEI));
}

TEST(DynamicsTest, TheIntegratorAddsNoDamping) {
  // The damping that users see must be the one they put in. At 32 Hz and 1 ms generalised-alpha
  // with rho = 0.9 has 6e-7; the vertex of a parabola through samples 0.2 rad apart is good to 1e-5
  // of the amplitude, over 400 half periods 1e-8.
  constexpr double kDampingRatio = 2e-6;
  constexpr double kW = 2 * M_PI * 32;
  const double EI = kW * kW * 0.05 * std::pow(0.3, 4) / std::pow(1.87510, 4);
  const Decay decay = FreeDecay(EI, 0, 1e-3, 400);
  EXPECT_NEAR(decay.w, kW, 0.01 * kW);  // (w dt)^2/12 lowers it by 0.3 %
  EXPECT_LT(std::abs(decay.zeta), kDampingRatio);
}

TEST(DynamicsTest, SecondOrderInTime) {
  // Halving the step quarters the error; where it is that small, higher orders still show.
  constexpr double kLeastRatio = 3.5;
  const auto apex = [](double dt) {
    Sweep sweep{0.0120, 0.22, 1.2e-5, Vector3d::UnitX(), 20, dt};
    return sweep.ApexAt(0.8);
  };
  const double coarse = apex(1e-3), fine = apex(5e-4), finest = apex(2.5e-4);
  EXPECT_GT(std::abs(coarse - fine) / std::abs(fine - finest), kLeastRatio);
}

TEST(DynamicsTest, AFailedStepLeavesTheStateAlone) {
  RodModel model = RoundCable(0.2, 0.008, 0.15, 0.008, 0.006, 1e-4, 5e-5, 40);
  const Pose a = Facing(Vector3d::Zero(), Vector3d::UnitZ());
  Pose b{{0.1, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Vector3d::UnitY()))};
  Rod rod(model);
  rod.SetConfiguration(BowedShape(a, b, 0.2, 40, model.gravity));
  ASSERT_TRUE(rod.Equilibrate().converged);
  const Vector3d apex = rod.pose(20).p;
  Pose torn = b;
  torn.p = {50, 30, -80};  // nowhere near
  Pose nan = b;
  nan.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(rod.Step(1e-3, a, nan).converged);
  EXPECT_EQ(rod.pose(20).p, apex);
  rod.Step(1e-3, a, torn);
  EXPECT_TRUE(rod.pose(20).p.allFinite());
}

}  // namespace
}  // namespace cosserat_cable::rod
