// Extensions of the section, against closed forms. Those of friction and of a stiffness that
// depends on the curvature are in test/rod.
#include <gtest/gtest.h>

#include <complex>

#include "cable/cable_cases.h"
#include "cable/cable_text.h"
#include "cosserat_cable/cable/cable_rod.h"
#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/rod/initial_shape.h"
#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/point_loads.h"
#include "cosserat_cable/rod/rod.h"
#include "tools/validation.h"

namespace cosserat_cable {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Complex = std::complex<double>;

constexpr double kLength = 0.2, kEI = 0.012, kGJ = 0.009;

rod::RodModel Specimen(const std::vector<CableExtension>& extensions, bool b_free, int elements) {
  CableModel m = RoundCableModel(kLength, 0.008, 0.09, kEI, kGJ, 0);
  m.eta_GJ = 0;
  m.elements = elements;
  m.extensions = extensions;
  rod::RodModel model = MakeRodModel(m, Vector3d::Zero());
  if (b_free) model.b = rod::EndModel::Free();
  return model;
}

/// At rest under a moment on its free end that follows the section.
rod::Rod Bent(const rod::RodModel& model, const Vector3d& moment) {
  rod::Rod rod(model);
  rod.SetConfiguration(rod::StraightShape(Pose{}, model.length, model.elements));
  rod::PointLoads load(model.length, {{model.length, Vector3d::Zero(), moment}});
  load.loads[0].follower = true;
  EXPECT_TRUE(rod.Equilibrate(moment.isZero() ? nullptr : &load).converged);
  return rod;
}

// ---- structural_damping -------------------------------------------------------------------------

constexpr int kPerPeriod = 100, kElements = 4;

/// Complex modulus of a short piece without mass to speak of, from the moment that turns one end.
Complex MeasureModulus(double loss_factor, double frequency, bool twist) {
  constexpr double kAngle = 0.02, kShort = 0.02;
  // The branches that matter have forgotten the start; what slower ones still know does not
  // vibrate.
  const int periods = 5 + static_cast<int>(std::min(25.0, std::ceil(3 * frequency)));
  CableModel m = RoundCableModel(kShort, 0.004, 1e-4, kEI, kGJ, 0);
  m.eta_GJ = 0;
  m.elements = kElements;
  m.extensions = {{"structural_damping", {{{"loss_factor", loss_factor}}}}};
  rod::Rod rod(MakeRodModel(m, Vector3d::Zero()));
  rod.SetConfiguration(rod::StraightShape(Pose{}, kShort, kElements));
  const double w = 2 * M_PI * frequency, dt = 1 / (frequency * kPerPeriod);
  Complex moment = 0, angle = 0;
  for (int k = 1; k <= kPerPeriod * periods; ++k) {
    const double phi = kAngle * std::sin(w * k * dt);
    Pose b;
    if (twist) {
      b = {{0, 0, kShort}, Quaterniond(AngleAxisd(phi, Vector3d::UnitZ()))};
    } else {  // on an arc
      const double along = phi == 0 ? kShort : kShort / phi * std::sin(phi);
      const double across = phi == 0 ? 0 : kShort / phi * (1 - std::cos(phi));
      b = {{0, -across, along}, Quaterniond(AngleAxisd(phi, Vector3d::UnitX()))};
    }
    EXPECT_TRUE(rod.Step(dt, Pose{}, b).converged);
    if (k <= kPerPeriod * (periods - 2)) continue;
    const Complex wave = std::exp(Complex(0, -w * k * dt));
    moment += (twist ? rod.moment(1).z() : rod.moment(1).x()) * wave;
    angle += phi * wave;
  }
  return moment / angle * kShort;
}

TEST(StructuralDamping, HasALossFactorThatDoesNotDependOnFrequency) {
  constexpr double kWithin = 0.03;  // as the key promises; the time step's part is (w dt)^2/12
  for (const double loss_factor : {0.02, 0.1, 0.4, 1.0})
    for (const double frequency : {0.5, 0.8, 1.7, 4.0, 9.0, 20.0, 45.0, 100.0})
      for (const bool twist : {false, true}) {
        if (twist && frequency != 4) continue;
        const Complex modulus = MeasureModulus(loss_factor, frequency, twist);
        EXPECT_NEAR(modulus.imag() / modulus.real(), loss_factor, kWithin * loss_factor)
            << frequency << " Hz";
        EXPECT_GT(modulus.real(), twist ? kGJ : kEI);
        if (loss_factor == 0.1 && !twist &&
            (frequency == 0.5 || frequency == 9 || frequency == 100))
          Validate({"Causes", "structural_damping: loss factor at " + Shown(frequency) + " Hz",
                    "definition, E''/E'", loss_factor, modulus.imag() / modulus.real(),
                    kWithin * loss_factor, kElements, 1 / (frequency * kPerPeriod)});
      }
}

TEST(StructuralDamping, LeavesTheStiffnessOfRest) {
  const rod::Rod plain = Bent(Specimen({}, true, 8), {0.01, 0, 0.02});
  const rod::Rod damped =
      Bent(Specimen({{"structural_damping", {{{"loss_factor", 0.5}}}}}, true, 8), {0.01, 0, 0.02});
  EXPECT_LT((plain.curvature(3) - damped.curvature(3)).norm(), 1e-9);
}

TEST(StructuralDamping, DampsModesOfAllFrequenciesAlike) {
  // zeta = half the loss factor, of small ones and within what the modulus is.
  constexpr double kLoss = 0.04;
  CableModel m = RoundCableModel(0.6, 0.008, 0.09, kEI, kGJ, 0);  // from 3 Hz on
  m.eta_GJ = 0;
  m.extensions = {{"structural_damping", {{{"loss_factor", kLoss}}}}};
  rod::RodModel model = MakeRodModel(m, Vector3d::Zero());
  model.b = rod::EndModel::Free();
  rod::Rod rod(model);
  rod.SetConfiguration(rod::StraightShape(Pose{}, 0.6, m.elements));
  int seen = 0;
  for (const rod::Mode& mode : FindModes(rod, 6)) {
    if (std::abs(mode.lambda) > 2 * M_PI * 100) continue;
    EXPECT_NEAR(mode.zeta, 0.5 * kLoss, 0.03 * 0.5 * kLoss) << mode.w;
    if (seen == 0)
      Validate({"Causes", "structural_damping: damping ratio of a cantilever at loss factor 0.04",
                "half the loss factor", 0.5 * kLoss, mode.zeta, 0.03 * 0.5 * kLoss, m.elements});
    ++seen;
  }
  EXPECT_GE(seen, 4);
}

// ---- anisotropy ---------------------------------------------------------------------------------

CableExtension Anisotropy(double difference, double roll) {
  return {"anisotropy", {{{"difference", difference}, {"roll", roll}}}};
}

TEST(Anisotropy, HasTwoFrequenciesInPlanesThatAreRolled) {
  constexpr double kRelative = 2e-4;  // shear and rotary inertia, less than (d/L)^2
  // What of an element bends between its nodes does so without the coupling: 1/40^2 of that.
  constexpr double kAcross = 2e-4;
  for (const double roll : {0.0, 0.4, -1.1})
    for (const double difference : {0.3, -0.2}) {
      rod::RodModel model = Specimen({Anisotropy(difference, roll)}, true, 40);
      model.section.C_F *= 100;  // slender
      model.section.rhoJ *= 0.01;
      const std::vector<rod::Mode> modes = FindModes(Bent(model, {0, 0, 0}), 2);
      const double ratio = modes[1].w / modes[0].w, d = std::abs(difference);
      const double expected = std::sqrt((1 + d) / (1 - d));
      EXPECT_NEAR(ratio, expected, kRelative * expected) << roll << " " << difference;
      if (roll != 0)
        Validate({"Causes",
                  "anisotropy: ratio of two frequencies, difference " + Shown(difference) +
                      ", roll " + Shown(roll),
                  "sqrt((1 + d)/(1 - d))", expected, ratio, kRelative * expected, 40});
      // The tip of the stiffer mode moves across the axis at `roll`.
      const rod::Mode& about_roll = modes[difference > 0 ? 1 : 0];
      const Vector3d axis(std::cos(roll), std::sin(roll), 0);
      EXPECT_NEAR(about_roll.displacement.back().normalized().dot(axis), 0, kAcross) << roll;
    }
}

TEST(Anisotropy, BendsAsItsMatrixSays) {
  constexpr double kRelative = 1e-4;  // the rod's turn [rad], with which the moment's axis goes
  constexpr double kDifference = 0.4, kRoll = 0.7;
  const Vector3d moment(1e-6, -2e-6, 0);
  const rod::Rod rod = Bent(Specimen({Anisotropy(kDifference, kRoll)}, true, 10), moment);
  const Matrix3d R = AngleAxisd(kRoll, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d stiffness(kEI * (1 + kDifference), kEI * (1 - kDifference), kGJ);
  const Vector3d kappa = R * (R.transpose() * moment).cwiseQuotient(stiffness);
  for (const int e : {0, 9}) {
    EXPECT_LT((rod.curvature(e) - kappa).norm(), kRelative * kappa.norm());
    EXPECT_LT((rod.moment(e) - moment).norm(), kRelative * moment.norm());
  }
}

TEST(Anisotropy, DoesNotGoWithTwoStiffnesses) {
  EXPECT_EQ(Load(Replaced(kSpecimen, "EI: 0.012", "EI1: 0.012\n  EI2: 0.013") +
                 "  extensions: {anisotropy: {difference: 0.1}}\n")
                .said,
            "f:10: cable.extensions.anisotropy: got a difference beside an EI1 and an EI2 that "
            "differ already, expected EI alone\n");
  EXPECT_EQ(SaidWith("  extensions: {anisotropy: {difference: -1, roll: 45}}\n"),
            "f:9: cable.extensions.anisotropy.difference: got -1, expected a number in (-1, 1)\n"
            "f:9: cable.extensions.anisotropy.roll: got 45, expected a number in [-7, 7] [rad]: is "
            "it in degrees?\n");
}

// ---- rest_curvature -----------------------------------------------------------------------------

CableExtension RestCurvature(double k1, double k2, double twist) {
  return {"rest_curvature", {{{"k1", k1}, {"k2", k2}, {"twist", twist}}}};
}

TEST(RestCurvature, AFreeCableIsACircle) {
  constexpr double kClose = 1e-8;  // of the circle's length, the fourth power of an element's turn
  constexpr double k = 6;
  const rod::Rod rod = Bent(Specimen({RestCurvature(k, 0, 0)}, true, 16), {0, 0, 0});
  for (int i = 0; i <= 16; ++i) {
    const double angle = k * kLength * i / 16;
    const Vector3d expected(0, -(1 - std::cos(angle)) / k, std::sin(angle) / k);
    EXPECT_LT((rod.pose(i).p - expected).norm(), kClose) << i;
  }
  Validate({"Causes", "rest_curvature: tip of a free cable, across [m]", "circle",
            -(1 - std::cos(k * kLength)) / k, rod.pose(16).p.y(), kClose, 16});
  EXPECT_LT(rod.elastic_energy(), 1e-15);
}

TEST(RestCurvature, WithTwistItIsAHelix) {
  // R' = R [K0]: constant in the section's frame, so that R(s) = exp(s K0), and r the integral of
  // its third column.
  const Vector3d K0(4, -3, 7);
  const rod::Rod rod = Bent(Specimen({RestCurvature(K0.x(), K0.y(), K0.z())}, true, 40), {0, 0, 0});
  const double k = K0.norm();
  const Vector3d n = K0 / k;
  for (const int i : {10, 25, 40}) {
    const double s = kLength * i / 40;
    const Vector3d e3 = Vector3d::UnitZ();
    const Vector3d expected = s * n.dot(e3) * n + std::sin(k * s) / k * (e3 - n.dot(e3) * n) +
                              (1 - std::cos(k * s)) / k * n.cross(e3);
    EXPECT_LT((rod.pose(i).p - expected).norm(), 1e-6) << i;  // fourth order in an element's turn
    EXPECT_LT(rod.pose(i).q.angularDistance(RotationExp(s * K0)), 1e-7) << i;
    if (i == 40)
      Validate({"Causes", "rest_curvature: tip of a free cable with twist, along [m]", "helix",
                expected.z(), rod.pose(i).p.z(), 1e-6, 40});
  }
}

TEST(RestCurvature, ItsOffsetTurnsWithTheRoll) {
  const rod::RodModel model = Specimen({RestCurvature(3, 0, 0)}, true, 16);
  const Vector3d straight = Bent(model, {0, 0, 0}).pose(16).p;
  const Pose rolled{{0, 0, 0}, Quaterniond(AngleAxisd(0.8, Vector3d::UnitZ()))};
  rod::Rod rod(model);
  rod.SetConfiguration(rod::StraightShape(rolled, kLength, 16));
  ASSERT_TRUE(rod.Equilibrate().converged);
  EXPECT_LT((rod.pose(16).p - rolled.q * straight).norm(), 1e-9);
  EXPECT_GT(straight.head<2>().norm(), 0.05);
}

TEST(RestCurvature, AsksForANumberThatActs) {
  EXPECT_EQ(SaidWith("  extensions: {rest_curvature: {}}\n"),
            "f:9: cable.extensions.rest_curvature: got nothing that acts, expected at least one of "
            "k1, k2, twist\n");
  EXPECT_EQ(LoadOne(std::string(kSpecimen) + "  extensions: {rest_curvature: {k2: -2}}\n")
                .extensions[0]
                .parts[0],
            (std::map<std::string, double>{{"k1", 0}, {"k2", -2}, {"twist", 0}}));
}

// ---- bend_twist_coupling ------------------------------------------------------------------------

TEST(BendTwistCoupling, APureBendingMomentTwists) {
  constexpr double kRelative = 1e-8;  // Newton's last correction
  for (const double c : {0.3, -0.6}) {
    const rod::RodModel model =
        Specimen({{"bend_twist_coupling", {{{"c1", c}, {"c2", 0.0}}}}}, true, 10);
    constexpr double kMoment = 0.02;
    const rod::Rod rod = Bent(model, {kMoment, 0, 0});
    // Inverse of [EI, c sqrt(EI GJ); c sqrt(EI GJ), GJ].
    const double bent = kMoment / (kEI * (1 - c * c));
    const double twisted = -c * kMoment / ((1 - c * c) * std::sqrt(kEI * kGJ));
    // The moment follows the tip's section: along the rod it stays (kMoment, 0, 0) only in an
    // element's frame whose axis of turning is the moment's. Where it is not, its components turn;
    // an element at the tip sees it as it is.
    const Vector3d kappa = rod.curvature(9);
    EXPECT_NEAR(kappa.x(), bent, 0.02 * bent);
    EXPECT_NEAR(kappa.z(), twisted, 0.02 * std::abs(twisted));
    const Vector3d m = rod.moment(9);
    Eigen::Matrix2d stiffness;
    stiffness << kEI, c * std::sqrt(kEI * kGJ), c * std::sqrt(kEI * kGJ), kGJ;
    const Eigen::Vector2d by = stiffness.inverse() * Eigen::Vector2d(m.x(), m.z());
    EXPECT_NEAR(kappa.x(), by.x(), kRelative * bent);
    EXPECT_NEAR(kappa.z(), by.y(), kRelative * bent);
  }
}

TEST(BendTwistCoupling, OfASmallMomentTheTipTurnsByTheCompliance) {
  constexpr double kRelative = 1e-4;  // the rod's turn [rad], with which the moment's axis goes
  constexpr double c1 = 0.3, c2 = -0.5, kMoment = 1e-5;
  const rod::RodModel model =
      Specimen({{"bend_twist_coupling", {{{"c1", c1}, {"c2", c2}}}}}, true, 10);
  Matrix3d stiffness = Vector3d(kEI, kEI, kGJ).asDiagonal();
  stiffness(0, 2) = stiffness(2, 0) = c1 * std::sqrt(kEI * kGJ);
  stiffness(1, 2) = stiffness(2, 1) = c2 * std::sqrt(kEI * kGJ);
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)}) {
    const rod::Rod rod = Bent(model, kMoment * direction);
    const Vector3d turn = kLength * stiffness.inverse() * (kMoment * direction);
    const Vector3d turned = RotationLog(rod.pose(10).q);
    EXPECT_LT((turned - turn).norm(), kRelative * turn.norm() + 1e-10);
    const char* source = "inverse of the 3x3 stiffness";
    const double within = kRelative * turn.norm() + 1e-10;
    if (direction.x() == 1)
      Validate({"Causes", "bend_twist_coupling: twist of the tip by a bending moment [rad]", source,
                turn.z(), turned.z(), within, 10});
    if (direction.z() == 1)
      Validate({"Causes", "bend_twist_coupling: turn of the tip about a2 by a torque [rad]", source,
                turn.y(), turned.y(), within, 10});
  }
}

TEST(BendTwistCoupling, StaysPositive) {
  EXPECT_EQ(SaidWith("  extensions: {bend_twist_coupling: {c1: 0.8, c2: -0.6}}\n"),
            "f:9: cable.extensions.bend_twist_coupling: got c1^2 + c2^2 = 1, expected less than "
            "1\n");
}

// ---- Keys of the others -------------------------------------------------------------------------

TEST(SectionFriction, HasItsKeys) {
  EXPECT_EQ(LoadOne(std::string(kSpecimen) +
                    "  extensions: {section_friction: {EI: 0.004, slip_curvature: 2}}\n")
                .extensions[0]
                .parts[0],
            (std::map<std::string, double>{{"EI", 0.004}, {"slip_curvature", 2}, {"spread", 0.5}}));
  EXPECT_EQ(
      SaidWith("  extensions: {section_friction: {EI: -1, spread: 2}}\n"),
      "f:9: cable.extensions.section_friction.EI: got -1, expected a number in [0, 100000] [N "
      "m^2]\n"
      "f:9: cable.extensions.section_friction.slip_curvature: missing, expected a number in "
      "(0, 10000] [1/m]\n"
      "f:9: cable.extensions.section_friction.spread: got 2, expected a number in [0, 1]\n");
}

TEST(NonlinearStiffness, HasItsKeys) {
  EXPECT_EQ(
      SaidWith("  extensions: {nonlinear_stiffness: {change: -0.9}}\n"),
      "f:9: cable.extensions.nonlinear_stiffness.change: got -0.9, expected a number in "
      "(-0.85, 100]\n"
      "f:9: cable.extensions.nonlinear_stiffness.curvature: missing, expected a number in (0, "
      "10000] [1/m]\n");
}

TEST(NonlinearStiffness, IsPutIntoTheRod) {
  constexpr double kRelative = 1e-8, kMoment = 0.05;
  const rod::Rod rod =
      Bent(Specimen({{"nonlinear_stiffness", {{{"change", -0.4}, {"curvature", 4.0}}}}}, true, 8),
           {0, kMoment, 0});
  const double kappa = rod.curvature(3).y();
  EXPECT_NEAR(kEI * kappa * (1 - 0.4 * kappa * kappa / (kappa * kappa + 16)), kMoment,
              kRelative * kMoment);
}

}  // namespace
}  // namespace cosserat_cable
