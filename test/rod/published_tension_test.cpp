// Rods under tension against closed forms: strings, ropes, tethers, a taut lead between clamps that
// do not point at each other; from stiff to next to no bending stiffness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/point_loads.h"
#include "rod/ringing.h"
#include "rod/rod_cases.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 2, kRhoA = 0.05, kDiameter = 0.004, kGravity = 9.81, kWeight = 0.1;
constexpr double kTension = 80, kStretch = 5e-3;
/// What ten elements are held to, and 160.
constexpr double kFew = 1e-2, kMany = 1e-3;

/// A row's name: which rod, of how many elements.
std::string Named(const std::string& rod, double stiffness, int elements) {
  return rod + " = " + Shown(stiffness) + ", N = " + std::to_string(elements) + ": ";
}

double Allowed(int elements) { return elements < 160 ? kFew : kMany; }

/// Along x, stretched by `stretch` to `tension`; EI by T L^2.
RodModel TautModel(double tension, double stretch, double stiffness, int elements) {
  const double EI = stiffness * tension * kLength * kLength, EA = tension / stretch;
  RodModel model = RoundCable(kLength, kDiameter, kRhoA, EI, 0.75 * EI, 0, 0, elements);
  // Neither shear nor what its weight lengthens it by is in the closed forms: 1e-4 at most.
  model.section.C_F = {100 * EA, 100 * EA, EA};
  model.gravity *= kWeight;
  model.section.V_F.setZero();
  return model;
}

/// Between clamps along x, `stretch` farther apart than its length.
Rod Stretched(const RodModel& model, double stretch, double tilt = 0) {
  const Vector3d along = Vector3d::UnitX(), up = Vector3d::UnitZ();
  const Pose a = Facing(Vector3d::Zero(), along + tilt * up);
  const Pose b = Facing(model.length * (1 + stretch) * along, along + tilt * up);
  Rod rod(model);
  rod.SetConfiguration(BowedShape(a, b, model.length, model.elements, -up));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

/// Sag of a clamped beam under its weight w [N/m] and a tension, at its middle.
double ClampedSag(double w, double length, double tension, double EI) {
  const double k = std::sqrt(tension / EI);
  return w * length * length / (8 * tension) -
         w * length / (2 * tension * k) * std::tanh(k * length / 4);
}

/// Lowest angular frequency of a clamped beam under tension: where
/// 2 a b (1 - cosh b cos a) + (b^2 - a^2) sinh b sin a = 0 with b^2 - a^2 = T L^2/EI, w = a b.
double ClampedFrequency(double rhoA, double length, double tension, double EI) {
  const double stiffness = EI / (tension * length * length);
  const auto miss = [&](double a) {
    const double b = std::sqrt(a * a + 1 / stiffness);
    return 2 * a * b * (1 / std::sinh(b) - std::cos(a) / std::tanh(b)) +
           (b * b - a * a) * std::sin(a);
  };
  double low = M_PI, high = 4.8;  // a string's and a beam's
  EXPECT_NE(miss(low) > 0, miss(high) > 0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((miss(middle) > 0) == (miss(low) > 0) ? low : high) = middle;
  }
  const double b = std::sqrt(low * low + 1 / stiffness);
  return low * b * std::sqrt(EI / (rhoA * std::pow(length, 4)));
}

TEST(PublishedTension, ATautWireHasItsTensionSagAndPitch) {
  const double now = kLength * (1 + kStretch), rhoA = kRhoA / (1 + kStretch);
  for (const double stiffness : {1e-2, 1e-4, 1e-6})
    for (const int elements : {10, 20, 40, 160}) {
      const RodModel model = TautModel(kTension, kStretch, stiffness, elements);
      const double EI = model.section.C_M.x() * (1 + kStretch);
      const Rod rod = Stretched(model, kStretch);
      const std::string name = Named("taut wire, EI/(T L^2)", stiffness, elements);
      const double within = Allowed(elements);
      const double tension = std::abs(rod.reaction_b().force.x());
      Validate({"Tension", name + "T [N]", "EA x stretch", kTension, tension, within * kTension,
                elements});
      const double sag = ClampedSag(rhoA * kWeight * kGravity, now, kTension, EI);
      Validate({"Tension", name + "sag [m]", "clamped beam under tension", sag,
                -rod.pose(elements / 2).p.z(), within * sag, elements});
      const double w = ClampedFrequency(rhoA, now, kTension, EI);
      Validate({"Tension", name + "w [rad/s]", "clamped beam under tension", w,
                FindModes(rod, 2)[1].w, within * w, elements});
    }
}

TEST(PublishedTension, ClampsThatPointAsideHoldALayerOfBending) {
  // A lead through which a tension goes straight on, and whose ends are held askew: the moment at
  // the clamp is tilt sqrt(EI T), whatever the layer's width is to an element.
  constexpr double kTilt = 0.05;
  for (const double stiffness : {1e-4, 1e-6})
    for (const int elements : {10, 40, 160}) {
      const RodModel model = TautModel(kTension, kStretch, stiffness, elements);
      RodModel light = model;
      light.gravity.setZero();
      const Rod rod = Stretched(light, kStretch, kTilt);
      const double EI = model.section.C_M.x() * (1 + kStretch);
      // Antisymmetric between parallel clamps: k L/2 coth - 1 in the chord's share.
      const double k = std::sqrt(kTension / EI), half = 0.5 * kLength * (1 + kStretch);
      const double moment =
          std::atan(kTilt) * EI * k * k * half / (k * half / std::tanh(k * half) - 1);
      Validate({"Tension",
                Named("lead held askew, EI/(T L^2)", stiffness, elements) + "moment [N m]",
                "boundary layer sqrt(EI/T)", moment, rod.reaction_a().moment.norm(), 0.01 * moment,
                elements});
    }
}

/// With next to no bending stiffness, and all but inextensible where `stretch` is small.
RodModel RopeModel(double stiffness, double stretch, int elements) {
  const double weight = kRhoA * kGravity;
  RodModel model = TautModel(weight * kLength, stretch, stiffness, elements);
  model.gravity = {0, 0, -kGravity};
  model.section.C_M.z() = 1e-3;  // so that twisting is no slow mode
  return model;
}

/// The catenary through two points on a level: H/w [m].
double CatenaryParameter(double span, double length) {
  double low = 1e-2 * span, high = 1e3 * span;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (2 * middle * std::sinh(span / (2 * middle)) > length ? low : high) = middle;
  }
  return low;
}

/// A rope between clamps on a level that point along its catenary.
Rod HangingRope(const RodModel& model, double span) {
  const double slope = std::sinh(span / (2 * CatenaryParameter(span, model.length)));
  const Pose a = Facing(Vector3d::Zero(), Vector3d(1, 0, -slope));
  const Pose b = Facing({span, 0, 0}, Vector3d(1, 0, slope));
  Rod rod(model);
  rod.SetConfiguration(BowedShape(a, b, model.length, model.elements, -Vector3d::UnitZ()));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

TEST(PublishedTension, ARopeHangsInItsCatenary) {
  constexpr double kSpan = 0.8 * kLength;
  const double a = CatenaryParameter(kSpan, kLength), w = kRhoA * kGravity;
  const double sag = a * (std::cosh(kSpan / (2 * a)) - 1), H = w * a;
  for (const double stiffness : {1e-6, 1e-10})
    for (const int elements : {10, 20, 40, 160}) {
      const Rod rod = HangingRope(RopeModel(stiffness, 1e-6, elements), kSpan);
      const std::string name = Named("rope, EI/(w L^3)", stiffness, elements);
      Validate({"Tension", name + "sag [m]", "catenary", sag, -rod.pose(elements / 2).p.z(),
                Allowed(elements) * sag, elements});
      Validate({"Tension", name + "H [N]", "catenary", H, rod.reaction_b().force.x(),
                Allowed(elements) * H, elements});
    }
}

TEST(PublishedTension, AShallowRopeHasIrvinesFrequencies) {
  // Of a parabola: off by the square of the slope at its ends, 6e-3 here.
  constexpr double kSpan = 0.999 * kLength, kStiff = 1e-4, kWithin = 1e-2;
  for (const double stiffness : {1e-6, 1e-10})
    for (const int elements : {20, 80}) {
      const Rod rod = HangingRope(RopeModel(stiffness, kStiff, elements), kSpan);
      const double H = rod.reaction_b().force.x(), w = kRhoA * kGravity;
      const double slope = w * kSpan / (2 * H), EA = rod.model().section.C_F.z();
      // (8 sag/S)^2 S EA/(H L_e), with 8 sag/S = 2 slope, L_e = S (1 + 2 slope^2/3)... of the rope.
      const double lambda2 = 4 * slope * slope * EA / H / (1 + 0.5 * slope * slope);
      const auto symmetric = [&](double half) {
        return std::tan(half) - half + 4 / lambda2 * half * half * half;
      };
      double low = M_PI / 2 + 1e-9, high = 1.5 * M_PI - 1e-9;
      for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (symmetric(middle) < 0 ? low : high) = middle;
      }
      const double string = std::sqrt(H / kRhoA) / kSpan;
      // Out of plane those of a string; in plane its second, and the symmetric one. The string's
      // second is there twice: shapes do not tell which is which.
      std::vector<double> expected = {M_PI * string, 2 * M_PI * string, 2 * M_PI * string,
                                      2 * low * string};
      std::sort(expected.begin(), expected.end());
      const std::vector<Mode> modes = FindModes(rod, 4);
      for (int n = 0; n < 4; ++n)
        Validate({"Tension",
                  Named("shallow rope, EI/(w L^3)", stiffness, elements) + "w of mode " +
                      std::to_string(n + 1) + " [rad/s]",
                  "Irvine 1981", expected[n], modes[n].w, kWithin * expected[n], elements});
    }
}

/// Lowest angular frequency of a chain in a field g [m/s^2] with `tip` [kg] at its end: where
/// J2(u0) Y0(u1) = Y2(u0) J0(u1), u = 2 w sqrt((x + tip/rhoA)/g) at the end and at the clamp.
double TetherFrequency(double rhoA, double length, double tip, double g) {
  const double mu = tip / rhoA;
  const auto miss = [&](double w) {
    const double u0 = 2 * w * std::sqrt(mu / g), u1 = 2 * w * std::sqrt((length + mu) / g);
    return std::cyl_bessel_j(2, u0) * std::cyl_neumann(0, u1) -
           std::cyl_neumann(2, u0) * std::cyl_bessel_j(0, u1);
  };
  // A pendulum's, from below: the tether's mass raises it.
  double low = 0.9 * std::sqrt(g / length), high = 1.3 * std::sqrt(g / length);
  EXPECT_NE(miss(low) > 0, miss(high) > 0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((miss(middle) > 0) == (miss(low) > 0) ? low : high) = middle;
  }
  return low;
}

RodModel TetherModel(double stiffness, int elements) {
  RodModel model = RopeModel(stiffness, 1e-4, elements);
  model.b = EndModel::Free();
  model.bodies = {{kLength, kRhoA * kLength}};
  return model;
}

TEST(PublishedTension, AHangingTetherSwingsWithItsLoad) {
  for (const double stiffness : {1e-6, 1e-10})
    for (const int elements : {10, 40}) {
      const RodModel model = TetherModel(stiffness, elements);
      Rod rod(model);
      rod.SetConfiguration(
          StraightShape(Facing(Vector3d::Zero(), -Vector3d::UnitZ()), kLength, elements));
      ASSERT_TRUE(rod.Equilibrate().converged);
      const std::string name =
          Named("tether under its own weight as load, EI/(w L^3)", stiffness, elements);
      const double weight = 2 * kRhoA * kLength * kGravity;
      Validate({"Tension", name + "T at the clamp [N]", "weights", weight,
                rod.reaction_a().force.z(), kMany * weight, elements});
      const double w = TetherFrequency(kRhoA, kLength, kRhoA * kLength, kGravity);
      Validate({"Tension", name + "w [rad/s]", "Bessel functions", w, FindModes(rod, 2)[0].w,
                kFew * w, elements});
    }
}

TEST(PublishedTension, ATowedTetherSwingsBehind) {
  // Towed along x at a constant acceleration, without weight: what hangs in a field of that size.
  constexpr double kTow = 40, kDt = 1e-3;
  constexpr int kElements = 10, kSteps = 4000;
  RodModel model = TetherModel(1e-8, kElements);
  model.gravity.setZero();
  model.section.V_F.z() = 1;  // N s: the jerk at the start dies away
  Rod rod(model);
  const Pose start = Facing(Vector3d::Zero(), -Vector3d::UnitX());
  rod.SetConfiguration(StraightShape(start, kLength, kElements));
  Motion tow;
  tow.a = kTow * Vector3d::UnitX();
  rod.AddRigidMotion(tow);
  std::vector<Vector3d> v(kElements + 1), omega(kElements + 1, Vector3d::Zero());
  for (int i = 0; i <= kElements; ++i) v[i] = 0.05 * i / kElements * Vector3d::UnitY();
  rod.SetVelocities(v, omega);
  std::vector<double> tip;
  for (int k = 1; k <= kSteps; ++k) {
    const double t = k * kDt;
    const Pose clamp{start.p + 0.5 * kTow * t * t * Vector3d::UnitX(), start.q};
    ASSERT_TRUE(rod.Step(kDt, clamp, clamp).converged) << k;
    tip.push_back(rod.pose(kElements).p.y());
  }
  const double pull = 2 * kRhoA * kLength * kTow;
  Validate({"Tension", "tether towed at 40 m/s^2 with its own mass as load: T at the clamp [N]",
            "mass times acceleration", pull, rod.reaction_a().force.x(), kFew * pull, kElements,
            kDt});
  const double w = TetherFrequency(kRhoA, kLength, kRhoA * kLength, kTow);
  Validate({"Tension", "the same: w [rad/s]", "Bessel functions", w, Listen(tip, kDt).Omega,
            kFew * w, kElements, kDt});
}

TEST(PublishedTension, APluckedWireKeepsItsEnergy) {
  // The law follows the tension of the last step, which swings by a tenth: what that makes or loses
  // is of second order in the step.
  constexpr double kWithin = 1e-3;  // of the energy at the start
  constexpr int kElements = 10, kSteps = 2000;
  RodModel model = TautModel(kTension, kStretch, 1e-6, kElements);
  model.gravity.setZero();
  Rod rod = Stretched(model, kStretch);
  const PointLoads pull(kLength, {{0.5 * kLength, {0, 5, 0}}});
  ASSERT_TRUE(rod.Equilibrate(&pull).converged);
  ASSERT_GT(rod.reaction_b().force.x(), 1.05 * kTension);
  const double stored = rod.elastic_energy();
  const Pose a = rod.pose(0), b = rod.pose(kElements);
  double worst = 0;
  for (int k = 0; k < kSteps; ++k) {
    ASSERT_TRUE(rod.Step(5e-4, a, b).converged);
    worst = std::max(worst, std::abs(rod.energy_balance().Residual()));
  }
  EXPECT_LT(worst, kWithin * stored);
}

TEST(PublishedTension, AFlexibleWireHangsStillAndIsPulledTaut) {
  // A wire that stretches by next to nothing: what bending takes up of its few elements' stretch
  // swings with the tension by more than the wire gives way. Left alone it hangs still, at any
  // step; pulled beyond its length it carries EA times its stretch.
  constexpr double kLong = 0.4, kSpan = 0.35, kWireEA = 5e4, kPulled = 1e-3;
  constexpr double kSwings = 3e-2;  // what its swinging on adds to the tension
  for (const double EI : {1e-4, 1e-8})
    for (const int elements : {4, 10, 20, 40})
      for (const double dt : {1e-3, 2e-4}) {
        RodModel model = RoundCable(kLong, 0.002, 0.03, EI, EI, 4e-3 * EI, 4e-3 * EI, elements);
        model.section.C_F = {kWireEA / 3, kWireEA / 3, kWireEA};
        model.section.V_F.z() = 4 * kLong / M_PI * std::sqrt(0.03 * kWireEA);
        model.gravity = {0, 0, -kGravity};
        const Vector3d along = Vector3d::UnitX();
        const Pose a = Facing(Vector3d::Zero(), along);
        Pose b = Facing(kSpan * along, along);
        Rod rod(model);
        rod.SetConfiguration(BowedShape(a, b, kLong, elements, -Vector3d::UnitZ()));
        ASSERT_TRUE(rod.Equilibrate().converged);
        const double stored = rod.elastic_energy();
        for (int k = 0; k < 200; ++k) ASSERT_TRUE(rod.Step(dt, a, b).converged);
        EXPECT_LT(rod.kinetic_energy(), 1e-6 * stored) << EI << " " << elements << " " << dt;
        if (dt < 1e-3) continue;
        for (int k = 1; k <= 500; ++k) {
          const double s = k / 500.0;
          b.p.x() = kSpan + ((1 + kPulled) * kLong - kSpan) * s * s * (3 - 2 * s);
          ASSERT_TRUE(rod.Step(dt, a, b).converged) << EI << " " << elements << " " << k;
        }
        for (int k = 0; k < 1000; ++k) ASSERT_TRUE(rod.Step(dt, a, b).converged);
        EXPECT_NEAR(rod.reaction_b().force.x(), kPulled * kWireEA, kSwings * kPulled * kWireEA)
            << EI << " " << elements;
      }
}

TEST(PublishedTension, TensionOnlyEverStiffens) {
  // The lowest frequency of a straight rod grows with each pull, from slack to far beyond
  // 12 EI/h^2.
  constexpr int kElements = 10;
  const RodModel model = TautModel(kTension, kStretch, 1e-5, kElements);
  double last = 0;
  for (double stretch = 1e-6; stretch < 1e-2; stretch *= 2) {
    const double w = FindModes(Stretched(model, stretch), 1)[0].w;
    EXPECT_GT(w, last) << stretch;
    last = w;
  }
}

}  // namespace
}  // namespace cosserat_cable::rod
