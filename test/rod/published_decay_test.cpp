// Free oscillations: the damping that a simulation shows is the damping that was put in.
#include <gtest/gtest.h>

#include "cosserat_cable/rod/point_loads.h"
#include "rod/ringing.h"
#include "rod/rod_cases.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 0.3, kRhoA = 0.05, kMu = 1.8751040687;

/// rhoA (L/mu0)^4, the source paper's C_bc [kg m^3].
double BendingFactor() { return kRhoA * std::pow(kLength / kMu, 4); }

/// Small free bending oscillation of a cantilever in its first mode, without gravity.
Ringing FreeDecay(double EI, double eta_EI, int elements, double dt, double half_periods) {
  RodModel model = RoundCable(kLength, 0.004, kRhoA, EI, EI, eta_EI, eta_EI, elements);
  if (eta_EI == 0) model.section.V_F.setZero();
  model.gravity.setZero();
  model.b = EndModel::Free();
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, kLength, elements));
  // A load in the shape of the mode pulls the beam into that shape. 1 mm at the tip: linear to
  // 1e-5.
  std::vector<Vec3<double>> forces;
  const double w_squared = EI / BendingFactor();
  for (int i = 0; i <= elements; ++i) {
    const double mass = kRhoA * kLength / elements * (i == elements ? 0.5 : 1.0);
    forces.push_back(
        {0.5e-3 * CantileverMode(i / static_cast<double>(elements)) * w_squared * mass, 0, 0});
  }
  const NodeForces pull(forces);
  EXPECT_TRUE(rod.Equilibrate(&pull).converged);
  const Pose clamp;
  std::vector<double> tip;
  const double end = half_periods * M_PI / std::sqrt(w_squared);
  for (int k = 1; k * dt < end; ++k) {
    EXPECT_TRUE(rod.Step(dt, clamp, clamp).converged);
    tip.push_back(rod.pose(elements).p.x());
  }
  return Listen(tip, dt);
}

TEST(PublishedDecay, EquationElevenGivesBackWhatWasPutIn) {
  // Shear and rotary inertia 1e-3, (w dt)^2/12 1e-5.
  constexpr double kWithin = 5e-3, kStiffnessWithin = 4e-3;
  constexpr double kEI = 0.02, kEta = 2e-5, kDt = 5e-4;
  constexpr int kElements = 40;
  const Ringing heard = FreeDecay(kEI, kEta, kElements, kDt, 21);
  const char* source = "source paper, eq. (11)";
  Validate({"Vibration", "decay of a cantilever: recovered eta_EI [N m^2 s]", source, kEta,
            2 * heard.delta * BendingFactor(), kWithin * kEta, kElements, kDt});
  Validate({"Vibration", "decay of a cantilever: recovered EI [N m^2]", source, kEI,
            heard.w() * heard.w() * BendingFactor(), kStiffnessWithin * kEI, kElements, kDt});
}

TEST(PublishedDecay, TheIntegratorAddsNoDamping) {
  // The damping that users see must be the one they put in. The vertex of a parabola through
  // samples 0.3 rad apart is good to 1e-4 of the amplitude: over 100 half periods 3e-7.
  constexpr double kWithin = 1e-5;  // of critical
  // Generalised-alpha with rho = 0.9 has 6e-7 at 32 Hz and 1 ms.
  constexpr double kAtThirtyTwo = 2e-6;
  constexpr int kElements = 20;
  for (const int hertz : {10, 32, 50})
    for (const double dt : {1e-3, 5e-4}) {
      const double w = 2 * M_PI * hertz, EI = w * w * BendingFactor();
      const Ringing heard = FreeDecay(EI, 0, kElements, dt, 200);
      EXPECT_NEAR(heard.w(), w, 0.01 * w);  // (w dt)^2/12 lowers it by 0.8 % at most
      if (hertz == 32) {
        EXPECT_LT(std::abs(heard.zeta()), kAtThirtyTwo);
      }
      Validate({"Numerics",
                "damping ratio of an undamped beam at " + std::to_string(hertz) + " Hz, dt " +
                    (dt == 1e-3 ? "1" : "0.5") + " ms",
                "none was put in", 0, heard.zeta(), kWithin, kElements, dt});
    }
}

TEST(PublishedDecay, TorsionalPendulum) {
  // Eqs. (12), (13): w^2 = GJ/(L J), 2 delta = (eta_GJ/L + D_E)/J, with a third of the cable's own
  // inertia in J (Rayleigh).
  constexpr double kWithin = 5e-3, kDt = 2e-4;
  constexpr int kElements = 20;
  constexpr double kGJ = 0.015, kDisc = 2e-6, kEta = 2e-6, kD_E = 4e-6;
  RodModel model = RoundCable(kLength, 0.008, 0.09, 0.02, kGJ, 1e-4, kEta, kElements);
  model.gravity.setZero();
  model.b = EndModel::Free();
  model.b.damping = {0, 0, kD_E};  // at the fixation; here the disc turns in it
  model.bodies = {{kLength, 0.05, {kDisc / 2, kDisc / 2, kDisc}}};
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, kLength, kElements));
  PointLoads twist(kLength, {{kLength, Vector3d::Zero(), {0, 0, kGJ / kLength * 0.5}}});
  twist.loads[0].follower = true;
  ASSERT_TRUE(rod.Equilibrate(&twist).converged);
  const Pose a;
  Pose released = rod.pose(kElements);
  released.q.setIdentity();
  std::vector<double> angle;
  for (int k = 0; k < 1500; ++k) {
    ASSERT_TRUE(rod.Step(kDt, a, released).converged);
    const Eigen::Quaterniond q = rod.pose(kElements).q;
    angle.push_back(2 * std::atan2(q.z(), q.w()));
  }
  const Ringing heard = Listen(angle, kDt);
  const double J = kDisc + model.section.rhoJ.z() * kLength / 3;
  const double w = std::sqrt(kGJ / (kLength * J)), delta = (kEta / kLength + kD_E) / (2 * J);
  Validate({"Vibration", "torsional pendulum: w [rad/s]", "source paper, eq. (12)", w, heard.w(),
            kWithin * w, kElements, kDt});
  Validate({"Vibration", "torsional pendulum: decay [1/s]", "source paper, eq. (13)", delta,
            heard.delta, kWithin * delta, kElements, kDt});
}

}  // namespace
}  // namespace cosserat_cable::rod
