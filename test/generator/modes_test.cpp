// Natural frequencies and damping of the generator's rod against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "oscillation.h"
#include "statics.h"

namespace cosserat_cable::generator {
namespace {

using Eigen::VectorXd;

// The polynomials resolve the first two bending modes to better than this, a few more of them the
// third.
constexpr double kResolved = 1e-7;
const Resolution kFiner = {12, 10, 20};
// A rod of d/L = 1/200 is an Euler-Bernoulli beam up to (d/L)^2 times a few.
constexpr double kSlender = 1e-4;
// What holds an end gives way by 1e-6 or so.
constexpr double kHeld = 1e-5;
// First-order perturbation by weight: the second order is that small for the weights here.
constexpr double kFirstOrder = 2e-3;

const double kPi = std::acos(-1.0);

CableData thick() {
  CableData c;
  c.length = 0.2;
  c.diameter = 0.02;
  c.rhoA = 0.09;
  c.EI = 0.012;
  c.GJ = 0.009;
  c.eta_EI = 5e-6;
  c.eta_GJ = 5e-6;
  return c;
}

CableData slender() {
  CableData c = thick();
  c.diameter = 0.001;
  return c;
}

Rod undamped(const CableData& data) {
  Rod rod = makeRod(data);
  rod.V_M.setZero();
  rod.V_F.setZero();
  return rod;
}

VectorXd straight(const RodDynamics& rod) { return VectorXd::Zero(rod.size()); }

/// Bending moment and shear force at the free end of a clamped Timoshenko beam vanish where this
/// does; w the frequency [rad/s].
double timoshenko(const Rod& rod, double w) {
  const double EI = rod.C_M[0], GA = rod.C_F[0], rhoA = rod.rhoA, rhoI = rod.rhoJ[0];
  const double L = rod.length, kappa = rhoA * w * w / GA;
  const double a2 = EI * GA, a1 = (GA * rhoI + EI * rhoA) * w * w;
  const double a0 = (rhoI * w * w - GA) * rhoA * w * w;
  const double discriminant = std::sqrt(a1 * a1 - 4.0 * a2 * a0);
  const double a = std::sqrt((-a1 + discriminant) / (2.0 * a2));
  const double b = std::sqrt((a1 + discriminant) / (2.0 * a2));
  const double ga = (a * a + kappa) / a, gb = (kappa - b * b) / b;
  // Columns: deflection cosh(ax), sinh(ax), cos(bx), sin(bx), and the rotations that go with them.
  Eigen::Matrix4d B;
  B.row(0) << 1.0, 0.0, 1.0, 0.0;
  B.row(1) << 0.0, ga, 0.0, -gb;
  B.row(2) << ga * a * std::cosh(a * L), ga * a * std::sinh(a * L), gb * b * std::cos(b * L),
      gb * b * std::sin(b * L);
  B.row(3) << (a - ga) * std::sinh(a * L), (a - ga) * std::cosh(a * L), -(b + gb) * std::sin(b * L),
      (b + gb) * std::cos(b * L);
  return B.determinant();
}

TEST(Modes, ClampedFreeTimoshenkoBeam) {
  const Rod data = undamped(thick());
  const double unit = std::sqrt(data.C_M[0] / data.rhoA) / (data.length * data.length);
  /// How far the nearest mode's frequency is from the closed form, relative.
  const auto error = [&](double mu, const Resolution& resolution) {
    RodDynamics rod(data, resolution);
    rod.gravity.setZero();
    const double euler = mu * mu * unit;
    const double exact =
        root([&data](double w) { return timoshenko(data, w); }, 0.75 * euler, 1.02 * euler);
    EXPECT_LT(exact, 0.999 * euler);
    double nearest = 1.0;
    for (const auto& mode : modesAbout(rod, straight(rod)))
      nearest = std::min(nearest, std::abs(mode.imag() / exact - 1.0));
    return nearest;
  };
  EXPECT_LT(error(1.875104, Resolution()), kResolved);
  EXPECT_LT(error(4.694091, Resolution()), kResolved);
  EXPECT_LT(error(7.854757, kFiner), kResolved);
}

TEST(Modes, KelvinVoigtDampingGrowsWithFrequency) {
  // All sections' viscosities one time constant: (12)'s zeta_n = w_n eta/(2 EI) without remainder.
  constexpr double kTime = 1e-4;
  Rod data = undamped(thick());
  RodDynamics without(data, Resolution());
  without.gravity.setZero();
  data.V_M = kTime * data.C_M;
  data.V_F = kTime * data.C_F;
  RodDynamics with(data, Resolution());
  with.gravity.setZero();
  const auto free = modesAbout(without, straight(without));
  const auto damped = modesAbout(with, straight(with));
  for (int i = 0; i < 6; ++i) {
    const double w = free[i].imag();
    EXPECT_NEAR(-damped[i].real() / (0.5 * w * w * kTime), 1.0, kResolved) << i;
    EXPECT_NEAR(std::abs(damped[i]) / w, 1.0, kResolved) << i;
  }
}

TEST(Modes, BendingDampingOfASlenderCable) {
  const CableData c = slender();
  RodDynamics rod(makeRod(c), Resolution());
  rod.gravity.setZero();
  const auto modes = modesAbout(rod, straight(rod));
  for (int i : {0, 2, 4}) {
    const double w = std::abs(modes[i]);
    EXPECT_NEAR(-modes[i].real() / (w * w * c.eta_EI / (2.0 * c.EI)), 1.0, 10.0 * kSlender);
  }
}

/// The deflection and slope at the clamp of a hanging beam, as power series from the free end.
double hanging(double weight, double square) {
  Eigen::Matrix2d B = Eigen::Matrix2d::Zero();
  for (int start = 0; start < 2; ++start) {
    Eigen::VectorXd c = VectorXd::Zero(80);
    c[start] = 1.0;
    for (int k = 0; k + 4 < c.size(); ++k) {
      c[k + 4] = (weight * (k + 1.0) * (k + 1.0) * c[k + 1] + square * c[k]) /
                 ((k + 4.0) * (k + 3.0) * (k + 2.0) * (k + 1.0));
    }
    B(0, start) = c.sum();
    for (int k = 1; k < c.size(); ++k) B(1, start) += k * c[k];
  }
  return B.determinant();
}

TEST(Modes, HangingCantilever) {
  CableData c = slender();
  for (double weight : {0.3, 1.8, 8.0}) {
    c.EI = c.rhoA * 9.81 * std::pow(c.length, 3) / weight;
    Rod data = undamped(c);
    data.C_F *= 100.0;  // softer EI, same slenderness: leave shear and stretch out of it
    RodDynamics rod(data, Resolution());
    FrameMotion down;
    down.R = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
    rod.clamp = [down](double) { return down; };
    const double square = std::pow(modesAbout(rod, loadedEquilibrium(rod))[0].imag(), 2);
    const double unit = c.EI / (c.rhoA * std::pow(c.length, 4));
    const double exact = root([weight](double x) { return hanging(weight, x); }, 10.0, 40.0);
    EXPECT_NEAR(square / (exact * unit), 1.0, kSlender) << weight;
    if (weight < 2.0) {
      EXPECT_NEAR(square / (12.362 * unit + 1.571 * 9.81 / c.length), 1.0, kFirstOrder) << weight;
    }
  }
}

TEST(Modes, MassAtTheEnd) {
  CableData c = slender();
  const double ratio = 0.4;  // to the cable's own mass
  c.masses = {{c.length, ratio * c.rhoA * c.length}};
  RodDynamics rod(undamped(c), Resolution());
  rod.gravity.setZero();
  const double mu = root(
      [ratio](double m) {
        return 1.0 + std::cos(m) * std::cosh(m) -
               ratio * m * (std::sin(m) * std::cosh(m) - std::cos(m) * std::sinh(m));
      },
      0.5, 1.875);
  const double exact = mu * mu * std::sqrt(c.EI / c.rhoA) / (c.length * c.length);
  EXPECT_NEAR(modesAbout(rod, straight(rod))[0].imag() / exact, 1.0, kSlender);
}

TEST(Modes, MassInTheMiddleAddsToItsMode) {
  // Rayleigh's bound from above by the mode without the mass, from below by Dunkerley's formula.
  CableData c = slender();
  RodDynamics bare(undamped(c), Resolution());
  bare.gravity.setZero();
  const double w = modesAbout(bare, straight(bare))[0].imag();
  c.masses = {{0.5 * c.length, 0.3 * c.rhoA * c.length}};
  RodDynamics rod(undamped(c), Resolution());
  rod.gravity.setZero();
  const double loaded = modesAbout(rod, straight(rod))[0].imag();
  const double shape = 0.3395230;  // of the first mode at half the length, 1 at the end
  const double rayleigh = w / std::sqrt(1.0 + 0.3 * 4.0 * shape * shape);
  const double compliance = std::pow(0.5 * c.length, 3) / (3.0 * c.EI);
  const double dunkerley = 1.0 / std::sqrt(1.0 / (w * w) + compliance * c.masses[0].mass);
  EXPECT_LT(loaded, rayleigh);
  EXPECT_GT(loaded, dunkerley);
}

TEST(Modes, BothEndsClamped) {
  CableData c = slender();
  Rod data = undamped(c);
  data.C_F *= 100.0;  // leave shear out of it
  RodDynamics rod(data, Resolution());
  rod.gravity.setZero();
  FrameMotion end;
  end.p.z() = c.length;
  EndHold hold;
  hold.pose = [end](double) { return end; };
  rod.holds.push_back(hold);
  // The torsion of a slender rod is far above: these are bending pairs.
  const auto modes = modesAbout(rod, straight(rod));
  const double unit = std::sqrt(c.EI / c.rhoA) / (c.length * c.length);
  EXPECT_NEAR(modes[0].imag() / (4.7300407 * 4.7300407 * unit), 1.0, kSlender + kHeld);
  EXPECT_NEAR(modes[2].imag() / (7.8532046 * 7.8532046 * unit), 1.0, kSlender + kHeld);
}

TEST(Modes, TorsionalPendulum) {
  // (12) and (13) hold for a cable without inertia; with it, b tan b = rhoJ L / J_disc.
  const CableData c = thick();
  const double own = makeRod(c).rhoJ[2] * c.length;
  RodDynamics rod(undamped(c), Resolution());
  rod.gravity.setZero();
  rod.disc.inertia = 3.0 * own;
  rod.disc.mass = 0.05;
  const double b = root([](double x) { return x * std::tan(x) - 1.0 / 3.0; }, 0.1, 1.5);
  const double exact = b / c.length * std::sqrt(c.GJ / makeRod(c).rhoJ[2]);
  bool found = false;
  for (const auto& mode : modesAbout(rod, straight(rod))) {
    found = found || std::abs(mode.imag() / exact - 1.0) < kResolved;
  }
  EXPECT_TRUE(found) << exact;
  // Rayleigh's third of the cable's own inertia is good to the square of its share.
  EXPECT_NEAR(exact / std::sqrt(c.GJ / (c.length * (rod.disc.inertia + own / 3.0))), 1.0, 2e-3);
}

}  // namespace
}  // namespace cosserat_cable::generator
