// Published frequencies, damping ratios and buckling loads, from the modes of the linearised rod.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "cosserat_cable/rod/modes.h"
#include "rod/published_rods.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

/// Angular frequencies of the modes of one kind [rad/s].
std::vector<double> Frequencies(ModeKind kind, const std::vector<Mode>& modes) {
  std::vector<double> w;
  for (const Mode& mode : modes)
    if (mode.kind == kind) w.push_back(mode.w);
  return w;
}

constexpr double kLength = 0.3, kRhoA = 0.05, kEI = 0.02;

Rod StraightBeam(double diameter, double eta_EI, int elements, bool free_end) {
  RodModel model = RoundCable(kLength, diameter, kRhoA, kEI, kEI, eta_EI, eta_EI, elements);
  model.gravity.setZero();
  if (free_end) model.b = EndModel::Free();
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, model.length, model.elements));
  return rod;
}

/// Angular frequency of Timoshenko's beam next to that of Euler and Bernoulli's with this mu: where
/// the state (w, psi, M, Q), integrated from the clamp, first meets the condition at the end.
double TimoshenkoFrequency(const Section& section, double length, double mu, bool free_end) {
  const double EI = section.C_M.x(), GA = section.C_F.x(), rhoI = section.rhoJ.x();
  const auto determinant = [&](double w) {
    constexpr int kSteps = 2000;  // fourth order: exact to rounding
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    a(0, 1) = 1;
    a(0, 3) = 1 / GA;
    a(1, 2) = 1 / EI;
    a(2, 1) = -rhoI * w * w;
    a(2, 3) = -1;
    a(3, 0) = -section.rhoA * w * w;
    a *= length / kSteps;
    const Eigen::Matrix4d step =
        Eigen::Matrix4d::Identity() + a + a * a / 2 + a * a * a / 6 + a * a * a * a / 24;
    Eigen::Matrix4d through = Eigen::Matrix4d::Identity();
    for (int i = 0; i < kSteps; ++i) through = step * through;
    return through.block<2, 2>(free_end ? 2 : 0, 2).determinant();
  };
  // Shear and rotary inertia lower it by a few per cent at most.
  const double bernoulli = mu * mu * std::sqrt(EI / (section.rhoA * std::pow(length, 4)));
  double high = 1.001 * bernoulli, low = 0.9 * bernoulli;
  const bool sign = determinant(high) > 0;
  EXPECT_NE(sign, determinant(low) > 0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((determinant(middle) > 0) == sign ? high : low) = middle;
  }
  return low;
}

TEST(PublishedModes, BeamsHaveTimoshenkosFrequencies) {
  constexpr double kWithin = 1e-3;  // relative
  constexpr int kElements = 80;
  const double mu_free[] = {1.87510, 4.69409, 7.85476}, mu_clamped[] = {4.73004, 7.85320, 10.99561};
  for (const bool free_end : {true, false}) {
    const Rod rod = StraightBeam(0.006, 2e-5, kElements, free_end);
    const std::vector<Mode> modes = FindModes(rod, 6);
    ASSERT_EQ(modes.size(), 6u);
    for (int n = 0; n < 3; ++n) {
      const double w = TimoshenkoFrequency(rod.model().section, kLength,
                                           free_end ? mu_free[n] : mu_clamped[n], free_end);
      Validate({"Vibration",
                std::string(free_end ? "clamped-free" : "clamped-clamped") + " beam, mode " +
                    std::to_string(n + 1) + ": w [rad/s]",
                "Timoshenko beam, integrated", w, modes[2 * n].w, kWithin * w, kElements});
      // Round: each twice, and told apart.
      EXPECT_NEAR(modes[2 * n + 1].w, w, kWithin * w);
      EXPECT_EQ(modes[2 * n].kind, ModeKind::kInPlane);
      EXPECT_EQ(modes[2 * n + 1].kind, ModeKind::kOutOfPlane);
    }
  }
}

TEST(PublishedModes, KelvinVoigtDampsEachModeByItsFrequency) {
  constexpr double kWithin = 0.01;  // relative
  constexpr int kElements = 40;
  constexpr double kEta = 2e-5;
  const std::vector<Mode> modes = FindModes(StraightBeam(0.004, kEta, kElements, true), 6);
  for (std::size_t n = 0; n < modes.size(); ++n) {
    const double zeta = modes[n].w * kEta / (2 * kEI);
    if (n % 2 == 0)
      Validate({"Vibration", "damping ratio of a beam, mode " + std::to_string(n / 2 + 1),
                "w eta_EI/(2 EI)", zeta, modes[n].zeta, kWithin * zeta, kElements});
    EXPECT_NEAR(modes[n].zeta, zeta, kWithin * zeta);
    EXPECT_NEAR(modes[n].lambda.real(), -zeta * modes[n].w, kWithin * zeta * modes[n].w);
    EXPECT_EQ(modes[n].second, std::conj(modes[n].lambda));
  }
}

/// Thin: neither stretch nor shear nor rotary inertia, all below 1e-5. EI = rhoA = L = 1, so w is
/// in units of sqrt(EI/(rhoA L^4)).
RodModel ThinModel(double GJ) {
  RodModel model = RoundCable(1, 0.004, 1, 1, GJ, 0, 0, 80);
  model.section.V_F.setZero();
  model.gravity.setZero();
  return model;
}

TEST(PublishedModes, ABeamWhoseEndSlidesAcross) {
  // Along one axis of a clamp that is turned about the beam: guided there (tan mu + tanh mu = 0),
  // clamped across it. Both clamps' axes are none of the world's.
  constexpr double kWithin = 2e-3;  // relative
  const double guided[] = {2.36502, 5.49780}, clamped[] = {4.73004, 7.85320};
  RodModel model = ThinModel(1);
  model.b.translation[0] = false;
  const Pose a{Vector3d(0.3, -0.2, 0.1),
               Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()))};
  const Eigen::Quaterniond roll(Eigen::AngleAxisd(0.4, Vector3d::UnitZ()));
  Rod rod(model);
  const std::vector<Pose> nodes = StraightShape(a, 1, model.elements);
  rod.SetConfiguration(nodes);
  rod.SetClamps(a, {nodes.back().p, nodes.back().q * roll});
  // The clamp turns the rod by its roll, which a round one does not notice.
  ASSERT_TRUE(rod.Equilibrate().converged);
  const std::vector<Mode> modes = FindModes(rod, 4);
  std::vector<double> expected = {guided[0], clamped[0], guided[1], clamped[1]};
  const Vector3d slide = a.q * roll * Vector3d::UnitX();
  for (int n = 0; n < 4; ++n) {
    const double w = expected[n] * expected[n];
    EXPECT_NEAR(modes[n].w, w, kWithin * w) << n;
    const Vector3d end = modes[n].displacement.back();
    EXPECT_NEAR(std::abs(end.dot(slide)), end.norm(), 1e-6) << n;
    EXPECT_EQ(end.norm() > 0.5, n % 2 == 0) << n;
  }
}

TEST(PublishedModes, UArchesHaveThePublishedFrequencies) {
  constexpr double kWithin = 2e-3;  // relative
  const double S[] = {2 / M_PI, 0.5, 0.4, 0.3};
  const double in_plane[] = {43.26, 36.47, 32.44, 28.71}, second[] = {95.2, 94.6, 92.8, 90.8};
  const double out_of_plane[] = {19.45, 17.21, 16.24, 15.58};
  for (int k = 0; k < 4; ++k)
    for (const double GJ : {0.75, 1.5}) {
      const RodModel model = ThinModel(GJ);
      const Pose a = Facing(Vector3d::Zero(), Vector3d::UnitZ());
      const Pose b{{S[k], 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Vector3d::UnitY()))};
      Rod rod(model);
      rod.SetConfiguration(BowedShape(a, b, 1, model.elements, -Vector3d::UnitZ()));
      ASSERT_TRUE(rod.Equilibrate().converged);
      const std::vector<Mode> modes = FindModes(rod, 6);
      const std::vector<double> in = Frequencies(ModeKind::kInPlane, modes);
      const std::vector<double> out = Frequencies(ModeKind::kOutOfPlane, modes);
      ASSERT_GE(in.size(), 2u);
      ASSERT_GE(out.size(), 1u);
      if (GJ == 0.75) {
        const std::string name = "U arch, clamps " + Shown(S[k]) + " L apart: ";
        const std::string unit = " w L^2 sqrt(rhoA/EI)";
        const char* source = "inextensible elastica";
        Validate({"Vibration", name + "in-plane" + unit, source, in_plane[k], in[0],
                  kWithin * in_plane[k], model.elements});
        Validate({"Vibration", name + "second in-plane" + unit, source, second[k], in[1],
                  kWithin * second[k], model.elements});
        Validate({"Vibration", name + "out-of-plane" + unit, source, out_of_plane[k], out[0],
                  kWithin * out_of_plane[k], model.elements});
      }
      // Of any GJ: the twisting moment of a round straight wire is constant along it, and zero in a
      // shape that is symmetric about its middle.
      EXPECT_NEAR(out[0], out_of_plane[k], kWithin * out_of_plane[k]);
      const auto swing = std::find_if(modes.begin(), modes.end(), [](const Mode& mode) {
        return mode.kind == ModeKind::kOutOfPlane;
      });
      EXPECT_LT(swing->twist, 1e-6);
    }
}

TEST(PublishedModes, BuckledBeamsHaveThePublishedFrequencies) {
  constexpr double kWithin = 2e-3;  // relative
  const double shortening[] = {0.05, 0.1, 0.2, 0.3, 0.5};
  const double in_plane[] = {44.15, 43.88, 43.08, 41.82, 37.27};
  for (int k = 0; k < 5; ++k) {
    const RodModel model = ThinModel(1);
    const Pose a = Facing(Vector3d::Zero(), Vector3d::UnitX());
    Pose b = a;
    b.p = Vector3d(1 - shortening[k], 0, 0);
    Rod rod(model);
    rod.SetConfiguration(BowedShape(a, b, 1, model.elements, Vector3d::UnitZ()));
    ASSERT_TRUE(rod.Equilibrate().converged);
    const std::vector<Mode> modes = FindModes(rod, 4);
    const std::vector<double> in = Frequencies(ModeKind::kInPlane, modes);
    ASSERT_FALSE(in.empty());
    Validate({"Vibration",
              "clamped arch, end shortening " + Shown(shortening[k]) +
                  " L: in-plane w L^2 sqrt(rhoA/EI)",
              "inextensible elastica", in_plane[k], in[0], kWithin * in_plane[k], model.elements});
    // A round wire may whirl about the line through its clamps: nothing holds that. What the
    // elements make of it vanishes with their length squared.
    EXPECT_LT(std::abs(modes[0].lambda), 0.01 * in_plane[k]);
    EXPECT_EQ(modes[0].kind, ModeKind::kOutOfPlane);
  }
}

TEST(PublishedModes, GravityStiffensAHangingCantilever) {
  // To first order; at a quarter more, the second is 2e-4.
  constexpr double kWithin = 1.5e-3;  // relative
  for (const double g : {0.0, 0.9, 1.8}) {
    RodModel model = RoundCable(1, 0.01, 1, 1, 1, 0, 0, 80);
    model.section.V_F.setZero();
    model.gravity = Vector3d(0, 0, -g);
    model.b = EndModel::Free();
    Rod rod(model);
    rod.SetConfiguration(
        StraightShape(Facing(Vector3d::Zero(), -Vector3d::UnitZ()), 1, model.elements));
    ASSERT_TRUE(g == 0 || rod.Equilibrate().converged);
    const double w_squared = 12.362 + 1.571 * g;
    const std::vector<Mode> modes = FindModes(rod, 2);
    Validate({"Vibration", "hanging cantilever, rhoA g L^3/EI = " + Shown(g) + ": w^2 rhoA L^4/EI",
              "12.362 + 1.571 rhoA g L^3/EI", w_squared, modes[0].w * modes[0].w,
              kWithin * w_squared, model.elements});
    EXPECT_NEAR(modes[1].w, modes[0].w, 1e-6 * modes[0].w);
  }
}

TEST(PublishedModes, HangingChain) {
  // Zeros of the Bessel function J0. A chain does not bend; what is left of EI raises the third
  // frequency most.
  constexpr double kWithin = 5e-3;  // relative
  constexpr int kElements = 160;
  constexpr double kG = 9.81;
  const double target[] = {1.2024, 2.7600, 4.3269};
  RodModel model = RoundCable(1, 0.002, 1, 5e-6 * kG, 5e-6 * kG, 0, 0, kElements);
  model.section.C_F.setConstant(1e5);
  model.section.V_F.setZero();
  model.gravity = Vector3d(0, 0, -kG);
  model.a = EndModel::Pinned();
  model.b = EndModel::Free();
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Facing(Vector3d::Zero(), -Vector3d::UnitZ()), 1, kElements));
  ASSERT_TRUE(rod.Equilibrate().converged);
  std::vector<double> w = Frequencies(ModeKind::kInPlane, FindModes(rod, 10));
  ASSERT_GE(w.size(), 3u);
  for (int n = 0; n < 3; ++n)
    Validate({"Vibration", "hanging chain, mode " + std::to_string(n + 1) + ": w sqrt(L/g)",
              "zeros of J0", target[n], w[n] / std::sqrt(kG), kWithin * target[n], kElements});
}

}  // namespace
}  // namespace cosserat_cable::rod
