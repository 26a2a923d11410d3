#include "cosserat_cable/rod/modes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <functional>

#include "rod/rod_cases.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

/// Modes of one kind, in their order.
std::vector<Mode> Only(ModeKind kind, const std::vector<Mode>& modes) {
  std::vector<Mode> chosen;
  std::copy_if(modes.begin(), modes.end(), std::back_inserter(chosen),
               [kind](const Mode& mode) { return mode.kind == kind; });
  return chosen;
}

constexpr double kLength = 0.3, kRhoA = 0.05, kEI = 0.02;

RodModel StraightModel(double diameter, double eta_EI, int elements) {
  RodModel model = RoundCable(kLength, diameter, kRhoA, kEI, kEI, eta_EI, eta_EI, elements);
  model.gravity.setZero();
  return model;
}

Rod Straight(const RodModel& model) {
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, model.length, model.elements));
  return rod;
}

TEST(ModesTest, WithoutDampingThereIsNone) {
  RodModel model = StraightModel(0.004, 0, 40);
  model.section.V_F.setZero();
  for (const Mode& mode : FindModes(Straight(model), 6)) {
    EXPECT_LT(std::abs(mode.zeta), 1e-10);  // rounding
    EXPECT_NEAR(mode.w_damped(), mode.w, 1e-8 * mode.w);
  }
}

TEST(ModesTest, TorsionAndStretchAreNamedAndAtTheirFrequencies) {
  // A bar clamped at one end: w = (pi/2L) sqrt(GJ/rhoJ), (pi/2L) sqrt(EA/rhoA).
  constexpr double kTolerance = 1e-3;  // pi^2/(96 N^2) = 6e-5
  RodModel model = StraightModel(0.012, 2e-5, 40);
  model.b = EndModel::Free();
  model.section.C_M.z() = 0.3 * kEI;
  const double by_length = M_PI / (2 * kLength);
  const double torsion = by_length * std::sqrt(model.section.C_M.z() / model.section.rhoJ.z());
  const double axial = by_length * std::sqrt(model.section.C_F.z() / model.section.rhoA);
  model.section.V_F.z() = 0.2 * model.section.C_F.z() / axial;  // damping ratio 0.1
  const std::vector<Mode> modes = FindModes(Straight(model), 14);
  const std::vector<Mode> twisting = Only(ModeKind::kTorsion, modes);
  const std::vector<Mode> stretching = Only(ModeKind::kAxial, modes);
  ASSERT_FALSE(twisting.empty());
  ASSERT_FALSE(stretching.empty());
  EXPECT_NEAR(twisting[0].w, torsion, kTolerance * torsion);
  EXPECT_NEAR(stretching[0].w, axial, kTolerance * axial);
  EXPECT_NEAR(stretching[0].zeta, 0.1, kTolerance);
  EXPECT_NEAR(twisting[0].torsion, 1, 1e-6);
  EXPECT_NEAR(stretching[0].stretch, 1, 1e-6);
  // Largest rotation 1 rad at the free end, about the rod; largest displacement 1 m along it.
  EXPECT_NEAR(std::abs(twisting[0].rotation.back().z()), 1, 1e-6);
  EXPECT_NEAR(stretching[0].displacement.back().z(), 1, 1e-6);
  EXPECT_EQ(stretching[0].displacement.front(), Vector3d::Zero());
}

TEST(ModesTest, AFreeRodHasSixRigidModes) {
  constexpr double kTolerance = 1e-3;
  RodModel model = StraightModel(0.004, 2e-5, 40);
  model.a = model.b = EndModel::Free();
  const std::vector<Mode> modes = FindModes(Straight(model), 8);
  for (int n = 0; n < 6; ++n) {
    EXPECT_EQ(modes[n].w, 0);
    EXPECT_EQ(modes[n].lambda, std::complex<double>(0));
  }
  const double w = std::pow(4.73004, 2) * std::sqrt(kEI / (kRhoA * std::pow(kLength, 4)));
  EXPECT_NEAR(modes[6].w, w, 3 * kTolerance * w);  // shear and rotary inertia: 1e-3
}

/// What follows when a rod is let go after a pull in a mode's shape: the node that the mode moves
/// most, along the direction in which it does, from rest [m].
class Release {
 public:
  Release(Rod* rod, const Mode& mode, double pull) : rod_(*rod) {
    const RodModel& model = rod_.model();
    const int nodes = model.elements + 1;
    for (int i = 0; i < nodes; ++i)
      if (mode.displacement[i].norm() > mode.displacement[node_].norm()) node_ = i;
    direction_ = mode.displacement[node_].normalized();
    rest_ = rod_.pose(node_).p;
    a_ = rod_.pose(0);
    b_ = rod_.pose(nodes - 1);
    std::vector<Vec3<double>> forces;
    for (int i = 0; i < nodes; ++i) {
      const double mass =
          model.section.rhoA * model.length / model.elements * (i + 1 == nodes ? 0.5 : 1);
      const Vector3d f = pull * mass * mode.w * mode.w * mode.displacement[i];
      forces.push_back({f.x(), f.y(), f.z()});
    }
    const NodeForces load(forces);
    EXPECT_TRUE(rod_.Equilibrate(&load).converged);
  }

  double Step(double dt) {
    EXPECT_TRUE(rod_.Step(dt, a_, b_).converged);
    return (rod_.pose(node_).p - rest_).dot(direction_);
  }

 private:
  Rod& rod_;
  int node_ = 0;
  Vector3d direction_, rest_;
  Pose a_, b_;
};

TEST(ModesTest, AnOverdampedBeamCreepsAtTheSlowRate) {
  // zeta = 3: rates w (zeta -+ sqrt(zeta^2 - 1)).
  constexpr double kTolerance = 0.01;
  const double w = std::pow(1.87510, 2) * std::sqrt(kEI / (kRhoA * std::pow(kLength, 4)));
  const double zeta = 3, eta = 2 * zeta * kEI / w;
  RodModel model = StraightModel(0.004, eta, 40);
  model.b = EndModel::Free();
  Rod rod = Straight(model);
  const Mode mode = FindModes(rod, 2)[0];
  EXPECT_FALSE(mode.oscillates());
  EXPECT_NEAR(mode.zeta, zeta, kTolerance * zeta);
  const double root = std::sqrt(zeta * zeta - 1);
  EXPECT_NEAR(-mode.lambda.real(), w * (zeta - root), kTolerance * w * (zeta - root));
  EXPECT_NEAR(-mode.second.real(), w * (zeta + root), kTolerance * w * (zeta + root));

  Release release(&rod, mode, 1e-4);
  constexpr double kDt = 1e-3;
  double early = 0, late = 0;
  for (int k = 1; k <= 400; ++k) {
    late = release.Step(kDt);
    if (k == 200) early = late;
  }
  EXPECT_NEAR(std::log(late / early) / (200 * kDt), mode.lambda.real(),
              1e-3 * std::abs(mode.lambda));
}

/// The arch of the paper's experiments, at rest under gravity.
Rod PaperArch(double EI, double rhoA, double eta_EI) {
  constexpr int kElements = 40;
  const RodModel model = RoundCable(0.2, 0.008, rhoA, EI, 0.75 * EI, eta_EI, eta_EI / 2, kElements);
  const Pose a = Facing(Vector3d::Zero(), Vector3d::UnitZ());
  const Pose b{{0.1, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Vector3d::UnitY()))};
  Rod rod(model);
  rod.SetConfiguration(BowedShape(a, b, 0.2, kElements, model.gravity));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

TEST(ModesTest, AnOverdampedArchCreepsAtAboutTheSlowRate) {
  // Bent, it comes back at several rates near the slow one: within 5 % of each other here.
  constexpr double kTolerance = 0.05;
  Rod rod = PaperArch(0.012, 0.09, 2e-4);
  const Mode mode = Only(ModeKind::kInPlane, FindModes(rod, 4))[0];
  EXPECT_NEAR(mode.w / (2 * M_PI), 51, 0.03 * 51);  // known to two digits
  EXPECT_NEAR(mode.zeta, 3, 0.12 * 3);              // to one
  EXPECT_FALSE(mode.oscillates());
  Release release(&rod, mode, 1e-5);
  constexpr double kDt = 2.5e-4;
  double early = 0, late = 0;
  for (int k = 1; k <= 160; ++k) {
    late = release.Step(kDt);
    if (k == 40) early = late;
  }
  EXPECT_NEAR(std::log(late / early) / (120 * kDt), mode.lambda.real(),
              kTolerance * std::abs(mode.lambda));
}

TEST(ModesTest, ASimulatedArchRingsDownAsItsModesSay) {
  // Generalised-alpha lowers the frequency by (w dt)^2/12 = 2e-4; the parabola through the extrema
  // is good to 1e-4 of the amplitude.
  constexpr double kFrequency = 5e-4, kDamping = 0.01, kDt = 2.5e-4;
  for (const ModeKind kind : {ModeKind::kInPlane, ModeKind::kOutOfPlane}) {
    Rod rod = PaperArch(0.012, 0.22, 1.2e-5);
    const Mode mode = Only(kind, FindModes(rod, 4))[0];
    Release release(&rod, mode, 1e-5);
    std::vector<double> zeros, extrema;
    double before = 0, last = 0;
    for (int k = 1; zeros.size() < 13 && k < 4000; ++k) {
      const double x = release.Step(kDt);
      if (k > 1 && last * x < 0) zeros.push_back((k - 1 + last / (last - x)) * kDt);
      if (k > 2 && (last - before) * (x - last) < 0) {
        const double curvature = before - 2 * last + x, slope = 0.5 * (x - before);
        extrema.push_back(std::abs(last - 0.5 * slope * slope / curvature));
      }
      before = last;
      last = x;
    }
    ASSERT_EQ(zeros.size(), 13u);
    // Other modes are stirred as well, and die out sooner.
    const double w_damped = 8 * M_PI / (zeros[12] - zeros[4]);
    const double decrement = std::log(extrema[4] / extrema[10]) / 6;
    EXPECT_NEAR(w_damped, mode.w_damped(), kFrequency * w_damped) << ToString(kind);
    EXPECT_NEAR(decrement / std::hypot(M_PI, decrement), mode.zeta, kDamping * mode.zeta)
        << ToString(kind);
  }
}

/// A spring and a dashpot at the last node, towards the origin of the world along x.
class TipSpring : public Load {
 public:
  TipSpring(double k, double c) : k_(k), c_(c) {}
  void Evaluate(const Centreline& rod, LoadSink* sink) const override {
    const int tip = rod.elements();
    Mat3<double> by_position, by_velocity;
    by_position[0][0] = -k_;
    by_velocity[0][0] = -c_;
    sink->AddForce(tip - 1, 1.0, {-k_ * rod.position(tip).x - c_ * rod.velocity(tip).x, 0.0, 0.0},
                   by_position, by_velocity);
  }
  double Energy(const Centreline& rod) const override {
    const double x = rod.position(rod.elements()).x;
    return 0.5 * k_ * x * x;
  }

 private:
  double k_, c_;
};

TEST(ModesTest, LoadsStiffenAndDamp) {
  // Rayleigh's quotient with the beam's own first mode, whose modal mass is rhoA L/4 for 1 m at the
  // tip: good to second order in the small spring and dashpot.
  constexpr double kTolerance = 0.01;
  RodModel model = StraightModel(0.004, 0, 40);
  model.section.V_F.setZero();
  model.b = EndModel::Free();
  const Rod rod = Straight(model);
  const double w0 = FindModes(rod, 1)[0].w, mass = kRhoA * kLength / 4;
  const double k = 0.05 * mass * w0 * w0, c = 2 * 0.01 * mass * w0;
  const TipSpring spring(k, c);
  const std::vector<Mode> modes = FindModes(rod, 2, &spring);
  EXPECT_NEAR(modes[0].w, w0, 1e-6 * w0);  // across the spring
  EXPECT_NEAR(std::abs(modes[0].displacement.back().y()), 1, 1e-6);
  EXPECT_NEAR(modes[1].w * modes[1].w - w0 * w0, k / mass, 0.02 * k / mass);
  EXPECT_NEAR(modes[1].zeta, 0.01 * w0 / modes[1].w, kTolerance * 0.01);
}

TEST(ModesTest, SameBitsEachTime) {
  const Rod rod = PaperArch(0.012, 0.09, 2e-4);
  const std::vector<Mode> one = FindModes(rod, 6), two = FindModes(rod, 6);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t n = 0; n < one.size(); ++n) {
    EXPECT_EQ(one[n].w, two[n].w);
    EXPECT_EQ(one[n].lambda, two[n].lambda);
    EXPECT_EQ(one[n].displacement, two[n].displacement);
  }
}

TEST(ModesTest, ACoarseRodHasNoMoreModesThanUnknowns) {
  RodModel model = StraightModel(0.004, 2e-5, 2);
  const std::vector<Mode> modes = FindModes(Straight(model), 20);
  EXPECT_EQ(modes.size(), 6u);
}

}  // namespace
}  // namespace cosserat_cable::rod
