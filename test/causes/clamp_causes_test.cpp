// Clamps that give way and lose, as a cable's file has them, against closed forms. Friction and
// play of clamps are in test/rod.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "cable/cable_cases.h"
#include "cosserat_cable/cable/cable_rod.h"
#include "cosserat_cable/rod/initial_shape.h"
#include "cosserat_cable/rod/modes.h"
#include "rod/ringing.h"
#include "tools/root.h"
#include "tools/validation.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;
using Complex = std::complex<double>;

constexpr double kEI = 0.012, kGJ = 0.009;
constexpr int kElements = 40;

/// Without weight and losses, slender, its end b free.
rod::RodModel Cantilever(double length, double rhoA,
                         const std::vector<CableExtension>& extensions) {
  CableModel m = RoundCableModel(length, 0.008, rhoA, kEI, kGJ, 0);
  m.eta_GJ = 0;
  m.elements = kElements;
  m.extensions = extensions;
  rod::RodModel model = MakeRodModel(m, Vector3d::Zero());
  model.b = rod::EndModel::Free();
  model.section.C_F *= 100;
  model.section.rhoJ *= 0.01;
  return model;
}

rod::Rod Straight(const rod::RodModel& model) {
  rod::Rod rod(model);
  rod.SetConfiguration(rod::StraightShape(Pose{}, model.length, model.elements));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

CableExtension Gives(const std::string& path, double stiffness) {
  return {"clamp_compliance", {{{path, stiffness}}}};
}

TEST(ClampCompliance, LowersTheFrequencyOfACantilever) {
  // On a rotation spring, r = k L/EI: r (1 + cos b cosh b) = b (sin b cosh b - cos b sinh b).
  constexpr double kRelative = 5e-4;  // shear and rotary inertia, less than (d/L)^2
  constexpr double kLength = 0.2, kRhoA = 0.09, kClamped = 1.8751040687;
  for (const double r : {0.5, 5.0, 50.0}) {
    const double b = Root(
        [&](double x) {
          return r * (1 + std::cos(x) * std::cosh(x)) -
                 x * (std::sin(x) * std::cosh(x) - std::cos(x) * std::sinh(x));
        },
        1e-3, kClamped);
    const double w = std::pow(b / kLength, 2) * std::sqrt(kEI / kRhoA);
    const rod::Rod rod =
        Straight(Cantilever(kLength, kRhoA, {Gives("a.bending", r * kEI / kLength)}));
    Validate({"Causes", "clamp_compliance: w of a cantilever, k L/EI = " + Shown(r) + " [rad/s]",
              "beam on a rotation spring", w, rod::FindModes(rod, 1).front().w, kRelative * w,
              kElements});
  }
}

TEST(ClampCompliance, ShowsInTheFrequenciesOverTheLength) {
  // A heavy tip m on a light cable: 1/(m w^2 L^2) = L/(3 EI) + 1/k, a line over L. A clamp that
  // gives way is where it crosses L = 0, a softer cable is its slope.
  constexpr double kRelative = 2e-3;  // of the line: the cable's mass, of which 1e-4 swings along
  constexpr double kSpring = 0.1, kTip = 0.05, kRhoA = 1e-4;
  const auto value = [&](double length) {
    rod::RodModel model = Cantilever(length, kRhoA, {Gives("a.bending", kSpring)});
    model.bodies = {{length, kTip}};
    const double w = rod::FindModes(Straight(model), 1).front().w;
    return 1 / (kTip * std::pow(w * length, 2));
  };
  const double low = value(0.1), middle = value(0.2), high = value(0.3);
  EXPECT_NEAR(middle, 0.5 * (low + high), kRelative * middle) << "it is a line";
  const double slope = (high - low) / 0.2;
  Validate({"Causes", "clamp_compliance: k from 1/(w L)^2 over L [N m/rad]",
            "heavy tip on a light cantilever", kSpring, 1 / (low - 0.1 * slope),
            kRelative * kSpring, kElements});
  Validate({"Causes", "clamp_compliance: EI from the same line [N m^2]",
            "heavy tip on a light cantilever", kEI, 1 / (3 * slope), kRelative * kEI, kElements});
}

TEST(ClampDamping, TakesFromAPendulumWhatItsDashpotTakes) {
  // Torsion of a light cable with the inertia J at its end, behind the clamp's spring and dashpot:
  // J s^2 + 1/(L/GJ + 1/(k + c s)) = 0.
  constexpr double kRelative = 2e-3;  // a third of the cable's inertia stands for all of it
  constexpr double kLength = 0.2, kRhoA = 1e-3, kDisc = 2e-6, kDt = 2e-4;
  constexpr double kSpring = 2 * kGJ / kLength, kDashpot = 1e-4;
  rod::RodModel model =
      Cantilever(kLength, kRhoA,
                 {Gives("a.torsion", kSpring), {"clamp_damping", {{{"a.torsion", kDashpot}}}}});
  model.bodies = {{kLength, 0.05, {kDisc / 2, kDisc / 2, kDisc}}};
  const double J = kDisc + model.section.rhoJ.z() * kLength / 3;
  Complex s(0, std::sqrt(kGJ / (kLength * J)));
  for (int k = 0; k < 200; ++k) {
    const Complex stiffness = 1.0 / (kLength / kGJ + 1.0 / (kSpring + kDashpot * s));
    s = 0.5 * s + Complex(0, 0.5) * std::sqrt(stiffness / J);
  }
  ASSERT_GT(-s.real(), 0.01 * s.imag());
  rod::Rod rod = Straight(model);
  std::vector<Vector3d> v(kElements + 1, Vector3d::Zero()), omega;
  // The cable twists evenly, after the clamp.
  const double clamp = (kGJ / kLength) / (kGJ / kLength + kSpring);
  for (int i = 0; i <= kElements; ++i)
    omega.push_back(0.1 * (clamp + (1 - clamp) * i / kElements) * Vector3d::UnitZ());
  rod.SetVelocities(v, omega);
  std::vector<double> angle;
  const int skipped = static_cast<int>(2 * M_PI / s.imag() / kDt);  // what else has been started
  for (int k = 0; k < 6 * skipped; ++k) {
    ASSERT_TRUE(rod.Step(kDt, Pose{}, Pose{}).converged);
    const Eigen::Quaterniond q = rod.pose(kElements).q;
    if (k > skipped) angle.push_back(2 * std::atan2(q.z(), q.w()));
  }
  const rod::Ringing heard = rod::Listen(angle, kDt);
  const char* source = "J s^2 + 1/(L/GJ + 1/(k + c s)) = 0";
  const std::string where = "clamp_damping: pendulum behind a spring and dashpot, ";
  Validate({"Causes", where + "w [rad/s]", source, s.imag(), heard.Omega, kRelative * s.imag(),
            kElements, kDt});
  Validate({"Causes", where + "decay [1/s]", source, -s.real(), heard.delta,
            5 * kRelative * -s.real(), kElements, kDt});
}

}  // namespace
}  // namespace cosserat_cable
