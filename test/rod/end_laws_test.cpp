// Clamps with friction and play: the laws by themselves and at the end of a rod, in statics, in
// steps and in the linearisation.
#include <gtest/gtest.h>

#include <random>

#include "cosserat_cable/rod/clamp_friction.h"
#include "cosserat_cable/rod/clamp_play.h"
#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/point_loads.h"
#include "cosserat_cable/rod/rod_batch.h"
#include "rod/ringing.h"
#include "rod/rod_cases.h"
#include "tools/validation.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kStuck = 0.8, kSlipMoment = 0.004, kGap = 0.02, kBeyond = 2.0;

// ---- The laws by themselves ---------------------------------------------------------------------

void ExpectConsistent(const EndLaw& law, const Vector3d& psi) {
  // Central differences of 1e-7 rad; the potential's are rounded at 1e-16 J.
  constexpr double kStep = 1e-7, kTangent = 1e-6, kMoment = 1e-7;
  const Vector3d none = Vector3d::Zero();
  const EndLaw::Resistance at = law.Resist(psi, none);
  Matrix3d tangent;
  Vector3d slope;
  for (int k = 0; k < 3; ++k) {
    const Vector3d d = kStep * Vector3d::Unit(k);
    tangent.col(k) =
        (law.Resist(psi + d, none).moment - law.Resist(psi - d, none).moment) / (2 * kStep);
    slope[k] = (law.Potential(psi + d) - law.Potential(psi - d)) / (2 * kStep);
  }
  EXPECT_LT((tangent - at.by_psi).norm(), kTangent) << psi.transpose();
  EXPECT_LT((slope - at.moment).norm(), kMoment) << psi.transpose();
  EXPECT_EQ(at.by_psi, at.by_psi.transpose());
}

TEST(EndLawTest, TangentAndPotentialAreThoseOfTheMoment) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> angle(-0.05, 0.05);
  ClampFriction friction(kStuck, kSlipMoment);
  const ClampPlay play(kGap, kBeyond);
  for (int k = 0; k < 200; ++k) {
    const Vector3d psi(angle(rng), angle(rng), angle(rng));
    ExpectConsistent(friction, psi);
    ExpectConsistent(play, psi);
    friction.Commit(psi);
  }
}

TEST(EndLawTest, FrictionLosesWhatItsMomentDoesOnTheWay) {
  // Round a circle with radius A the slider follows: 2 pi slip_moment A a turn, less what radial
  // return cuts of the corner of each step.
  constexpr double kRelative = 1e-3, kRadius = 0.5;
  constexpr int kSteps = 2000;
  ClampFriction friction(kStuck, kSlipMoment);
  double lost = 0, work = 0;
  Vector3d before(kRadius, 0, 0), moment_before = Vector3d::Zero();
  friction.Rest(before);
  double energy_at_start = 0;
  for (int k = 1; k <= 2 * kSteps; ++k) {
    const double phase = 2 * M_PI * k / kSteps;
    const Vector3d psi(kRadius * std::cos(phase), kRadius * std::sin(phase), 0);
    const Vector3d moment = friction.Resist(psi, Vector3d::Zero()).moment;
    const double now = friction.Commit(psi);
    if (k > kSteps) {
      lost += now;
      work += 0.5 * (moment + moment_before).dot(psi - before);
    } else {
      energy_at_start = friction.Energy(psi);
    }
    before = psi;
    moment_before = moment;
  }
  // The slider runs on a circle that is smaller as the spring drags it at a right angle.
  const double behind = kSlipMoment / kStuck;
  const double path = 2 * M_PI * std::sqrt(kRadius * kRadius - behind * behind);
  EXPECT_NEAR(lost, kSlipMoment * path, kRelative * lost);
  EXPECT_NEAR(work, lost + friction.Energy(before) - energy_at_start, kRelative * lost);
}

TEST(EndLawTest, FrictionAtRestHasTurnedOnceFromZero) {
  const Vector3d little(0.3 * kSlipMoment / kStuck, -0.4 * kSlipMoment / kStuck, 0);
  const Vector3d far = 10 * little;
  ClampFriction friction(kStuck, kSlipMoment);
  friction.Commit(-far);  // a past that rest forgets
  EXPECT_NEAR((friction.ResistAtRest(little).moment - kStuck * little).norm(), 0,
              1e-12 * kSlipMoment);
  EXPECT_NEAR((friction.ResistAtRest(far).moment - kSlipMoment * far.normalized()).norm(), 0,
              1e-12 * kSlipMoment);
  friction.Rest(far);
  EXPECT_NEAR(friction.Energy(far), 0.5 * kSlipMoment * kSlipMoment / kStuck, 1e-12 * kSlipMoment);
}

// ---- At the end of a rod ------------------------------------------------------------------------

constexpr double kLength = 0.2, kEI = 0.012, kGJ = 0.009, kSpring = 0.05;

/// Bent by end b, which may go where it will but is turned: the moment is the same everywhere.
Rod PurelyBent(std::shared_ptr<const EndLaw> law, double spring) {
  RodModel model = RoundCable(kLength, 0.004, 0.05, kEI, kGJ, 0, 0, 20);
  model.gravity.setZero();
  model.a = EndModel::Sprung({spring, spring, 0}, Vector3d::Zero());
  model.a.rotation[2] = true;
  model.a.laws = {std::move(law)};
  model.b.translation = {false, false, false};
  Rod rod(model);
  rod.SetConfiguration(StraightShape(Pose{}, kLength, model.elements));
  return rod;
}

/// The moment [N m] that it takes to turn end b by `angle`.
double MomentAt(double angle, const Vector3d& axis, Rod* rod) {
  rod->SetClamps(Pose{}, {{0, 0, kLength}, Eigen::Quaterniond(AngleAxisd(angle, axis))});
  EXPECT_TRUE(rod->EquilibrateWithHistory().converged) << angle;
  return rod->reaction_b().moment.dot(axis);
}

TEST(EndLawTest, ARubbingClampHasTheLoopOfItsAmplitude) {
  // The rod's K = EI/L in series with spring and Jenkins element. Between -A and A of the clamp,
  // K (amplitude - A) = spring A + slip_moment, and a cycle loses 4 slip_moment (A - slip/stuck).
  constexpr double kRelative = 2e-3;  // corners between 400 samples a cycle
  constexpr double kNoLoop = 1e-12;   // [J] of 1e-4: while it sticks
  constexpr int kSteps = 400;
  const double K = kEI / kLength;
  const Vector3d axis = Vector3d(1, 2, 0).normalized();
  for (const double amplitude : {0.05, 0.3, 0.6, 1.2}) {
    Rod rod = PurelyBent(std::make_shared<ClampFriction>(kStuck, kSlipMoment), kSpring);
    double area = 0, before = 0, angle_before = 0;
    for (int k = 0; k <= 5 * kSteps / 4; ++k) {
      const double angle = amplitude * std::sin(2 * M_PI * k / kSteps);
      const double moment = MomentAt(angle, axis, &rod);
      if (k > kSteps / 4) area += 0.5 * (moment + before) * (angle - angle_before);
      before = moment;
      angle_before = angle;
    }
    const double A = (K * amplitude - kSlipMoment) / (K + kSpring),
                 slipped = A - kSlipMoment / kStuck;
    if (slipped <= 0)
      EXPECT_NEAR(area, 0, kNoLoop) << amplitude;
    else
      Validate({"Causes", "clamp_friction: loss in a cycle of " + Shown(amplitude) + " rad [J]",
                "loop of Jenkins' element in series", 4 * kSlipMoment * slipped, area,
                kRelative * area, 20});
  }
}

TEST(EndLawTest, RestForgetsFrictionAndHistoryKeepsIt) {
  constexpr double kTolerance = 1e-9;  // [N m]: Newton's last correction
  const double K = kEI / kLength;
  // The end's turn A where the clamp's angle is 0.5, and it slips; then back to 0.45, and it
  // sticks.
  const double there = 0.5, back = 0.45;
  const double A = (K * there - kSlipMoment) / (K + kSpring);
  ASSERT_GT(A, kSlipMoment / kStuck);
  Rod rod = PurelyBent(std::make_shared<ClampFriction>(kStuck, kSlipMoment), kSpring);
  EXPECT_NEAR(MomentAt(there, Vector3d::UnitX(), &rod), K * (there - A), kTolerance);
  const double A_back = (K * back - kSlipMoment + kStuck * A) / (K + kSpring + kStuck);
  ASSERT_LT(A - A_back, 2 * kSlipMoment / kStuck);
  EXPECT_NEAR(MomentAt(back, Vector3d::UnitX(), &rod), K * (back - A_back), kTolerance);
  const double A_once = (K * back - kSlipMoment) / (K + kSpring);
  ASSERT_TRUE(rod.Equilibrate().converged);
  EXPECT_NEAR(rod.reaction_b().moment.x(), K * (back - A_once), kTolerance);
}

TEST(EndLawTest, ALooseClampTurnsFreelyAndThenNot) {
  constexpr double kRelative = 1e-8;
  const double soft = 1 / (kLength / kEI + 1 / kBeyond);
  Rod rod = PurelyBent(std::make_shared<ClampPlay>(kGap, kBeyond), 0);
  const Vector3d axis = Vector3d(2, -1, 0).normalized();
  EXPECT_NEAR(MomentAt(0.85 * kGap, axis, &rod), 0, 1e-12);
  for (const double angle : {0.1, 0.5, 1.0}) {
    const double moment = (angle - kGap) * soft;
    EXPECT_NEAR(MomentAt(angle, axis, &rod), moment, kRelative);
    if (angle == 0.1)
      Validate({"Causes", "clamp_play: moment that bends by 0.1 rad [N m]",
                "springs in series beyond the gap", moment, rod.reaction_b().moment.dot(axis),
                kRelative, 20});
    EXPECT_NEAR(MomentAt(-angle, axis, &rod), -moment, kRelative);
  }
}

/// A stiff light rod with a heavy tip on a clamp that gives way: one degree of freedom.
struct Pendulum {
  static constexpr double kTip = 0.05, kArm = 0.2;

  Pendulum(std::shared_ptr<const EndLaw> law, double spring, double angle)
      : rod(Model(law, spring)) {
    rod.SetConfiguration(StraightShape(Pose{}, kArm, 8));
    // Turned as a whole; it falls back from there.
    std::vector<Pose> nodes;
    for (int i = 0; i <= 8; ++i) {
      const Eigen::Quaterniond q(AngleAxisd(angle, Vector3d::UnitY()));
      nodes.push_back({q * Vector3d(0, 0, kArm * i / 8), q});
    }
    rod.SetConfiguration(nodes);
    rod.SetClamps(Pose{}, nodes.back());
  }
  static RodModel Model(std::shared_ptr<const EndLaw> law, double spring) {
    RodModel model = RoundCable(kArm, 0.004, 1e-4, 50, 50, 1e-3, 1e-3, 8);
    model.gravity.setZero();
    model.a = EndModel::Sprung({spring, spring, 0}, Vector3d::Zero());
    model.a.rotation[2] = true;
    if (law) model.a.laws = {std::move(law)};
    model.b = EndModel::Free();
    model.bodies = {{kArm, kTip}};
    return model;
  }
  /// Of the tip about the clamp, after each of so many steps.
  std::vector<double> Swing(int steps, double dt) {
    std::vector<double> angle;
    for (int k = 0; k < steps; ++k) {
      EXPECT_TRUE(rod.Step(dt, Pose{}, Pose{}).converged) << k;
      angle.push_back(std::atan2(rod.position(8).x, rod.position(8).z));
    }
    return angle;
  }
  /// Of a small swing against `stiffness` [rad/s].
  static double W(double stiffness) { return std::sqrt(stiffness / (kTip * kArm * kArm)); }

  Rod rod;
};

std::vector<double> Peaks(const std::vector<double>& x) {
  std::vector<double> peaks;
  for (std::size_t k = 1; k + 1 < x.size(); ++k)
    if ((x[k] - x[k - 1]) * (x[k + 1] - x[k]) <= 0 && x[k] != x[k - 1])
      peaks.push_back(std::abs(x[k]));
  return peaks;
}

TEST(EndLawTest, FrictionTakesTheSameAmplitudeFromEverySwing) {
  // Coulomb: 2 slip_moment/spring each half swing, until it sticks. The slider's spring, a
  // thousand times as stiff, gives way by next to nothing.
  constexpr double kSwungSpring = 0.2, kMoment = 0.002;
  constexpr double kRelative = 0.01;  // the rod's own bending and 300 steps a swing
  Pendulum pendulum(std::make_shared<ClampFriction>(1000 * kSwungSpring, kMoment), kSwungSpring,
                    0.3);
  const double period = 2 * M_PI / Pendulum::W(kSwungSpring), dt = period / 300;
  const std::vector<double> peaks = Peaks(pendulum.Swing(static_cast<int>(4.2 * 300), dt));
  ASSERT_GE(peaks.size(), 7u);
  const double drop = 2 * kMoment / kSwungSpring;
  for (int k = 0; k < 7; ++k) EXPECT_NEAR(peaks[k], 0.3 - (k + 1) * drop, kRelative * 0.3) << k;
  Validate({"Causes", "clamp_friction: amplitude lost in a half swing [rad]",
            "Coulomb, 2 slip_moment/spring", drop, (peaks[0] - peaks[6]) / 6, 0.02 * drop, 8, dt});
  const EnergyBalance balance = pendulum.rod.energy_balance();
  EXPECT_LT(std::abs(balance.Residual()), 5e-3 * balance.dissipated);
  EXPECT_GT(balance.dissipated, 0.2 * 0.5 * kSwungSpring * 0.3 * 0.3);
}

TEST(EndLawTest, PlaySlowsSmallSwings) {
  // Between the stops it flies: T = 2 pi/w + 4 gap/(w (A - gap)).
  constexpr double kRelative = 5e-3;  // the rounded corner
  const double w = Pendulum::W(kBeyond);
  for (const double amplitude : {0.04, 0.06, 0.12}) {
    Pendulum pendulum(std::make_shared<ClampPlay>(kGap, kBeyond), 0, amplitude);
    const double period = 2 * M_PI / w + 4 * kGap / (w * (amplitude - kGap));
    const Ringing heard = Listen(pendulum.Swing(5 * 200, period / 200), period / 200);
    Validate({"Causes", "clamp_play: period of swings of " + Shown(amplitude) + " rad [s]",
              "2 pi/w + 4 gap/(w (A - gap))", period, 2 * M_PI / heard.Omega, kRelative * period, 8,
              period / 200});
    EXPECT_LT(std::abs(heard.delta) * period, 0.01) << "without loss";
  }
}

TEST(EndLawTest, SmallVibrationsStick) {
  // The modes of a rod whose clamp has just slipped are those of the slider's spring.
  constexpr double kRelative = 1e-6;
  const auto lowest = [](const RodModel& model, bool slips) {
    Rod rod(model);
    rod.SetConfiguration(StraightShape(Pose{}, Pendulum::kArm, 8));
    EXPECT_TRUE(rod.Equilibrate().converged);
    if (slips) {
      // There and back, until the tip is where it was: slipped, and pressed against the slider.
      PointLoads pull(Pendulum::kArm,
                      {{Pendulum::kArm, {2.1 * kSlipMoment / Pendulum::kArm, 0, 0}}});
      EXPECT_TRUE(rod.EquilibrateWithHistory(&pull).converged);
      EXPECT_TRUE(rod.EquilibrateWithHistory().converged);
    }
    return FindModes(rod, 1).front().w;
  };
  const auto friction = std::make_shared<ClampFriction>(kStuck, kSlipMoment);
  const double sticks = lowest(Pendulum::Model(nullptr, 0.2 + kStuck), false);
  EXPECT_NEAR(lowest(Pendulum::Model(friction, 0.2), false), sticks, kRelative * sticks);
  EXPECT_NEAR(lowest(Pendulum::Model(friction, 0.2), true), sticks, 1e-3 * sticks);
}

// ---- State --------------------------------------------------------------------------------------

std::vector<double> StateOf(const Rod& rod) {
  std::vector<double> all;
  for (int i = 0; i <= rod.elements(); ++i) {
    const Vec3<double> r = rod.position(i), v = rod.velocity(i);
    const Quat<double> q = rod.orientation(i);
    all.insert(all.end(), {r.x, r.y, r.z, v.x, v.y, v.z, q.w, q.x, q.y, q.z});
  }
  const EnergyBalance balance = rod.energy_balance();
  all.insert(all.end(), {balance.work_ends, balance.dissipated, balance.stored});
  return all;
}

RodModel Rubbing() {
  RodModel model = RoundCable(0.2, 0.008, 0.15, 0.008, 0.006, 1e-5, 5e-6, 20);
  model.a = EndModel::Sprung({0.05, 0.05, 0}, Vector3d::Zero());
  model.a.rotation[2] = true;
  model.a.laws = {std::make_shared<ClampFriction>(0.5, 1e-3),
                  std::make_shared<ClampPlay>(0.01, 0.3)};
  model.b = model.a;
  return model;
}

const Pose kA;
const Pose kB{{0.1, 0, 0}, Eigen::Quaterniond(0, 0, 1, 0)};

Rod Arch(const RodModel& model) {
  Rod rod(model);
  rod.SetConfiguration(BowedShape(kA, kB, model.length, model.elements, model.gravity));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

Pose Shaken(Pose clamp, int step) {
  clamp.p.x() += 2e-3 * (1 - std::cos(0.08 * step));
  clamp.q = clamp.q * AngleAxisd(0.05 * (1 - std::cos(0.06 * step)), Vector3d::UnitY());
  return clamp;
}

bool StepTo(int step, Rod* rod) {
  return rod->Step(1e-3, Shaken(kA, step), Shaken(kB, step)).converged;
}

TEST(EndLawTest, ACopyHasTheMemory) {
  Rod rod = Arch(Rubbing());
  for (int k = 1; k <= 25; ++k) ASSERT_TRUE(StepTo(k, &rod));
  Rod copy(rod);
  for (int k = 26; k <= 60; ++k) ASSERT_TRUE(StepTo(k, &rod));
  for (int k = 26; k <= 60; ++k) ASSERT_TRUE(StepTo(k, &copy));
  EXPECT_EQ(StateOf(rod), StateOf(copy));
  EXPECT_GT(rod.energy_balance().dissipated, 0);
}

TEST(EndLawTest, AFailedStepLeavesTheMemoryAlone) {
  Rod rod = Arch(Rubbing()), other = Arch(Rubbing());
  for (int k = 1; k <= 25; ++k) ASSERT_TRUE(StepTo(k, &rod) && StepTo(k, &other));
  Pose far = kB;
  far.p.x() = 50;
  far.q = Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5);
  ASSERT_FALSE(rod.Step(1e-3, kA, far).converged);
  for (int k = 26; k <= 40; ++k) ASSERT_TRUE(StepTo(k, &rod) && StepTo(k, &other));
  EXPECT_EQ(StateOf(rod), StateOf(other));
}

TEST(EndLawTest, EnergyOfAShakenArchBalances) {
  constexpr double kWithin = 5e-3;  // of the energy dissipated; slips begin between steps
  Rod rod = Arch(Rubbing());
  for (int k = 1; k <= 1000; ++k) ASSERT_TRUE(StepTo(k, &rod));
  const EnergyBalance balance = rod.energy_balance();
  EXPECT_LT(std::abs(balance.Residual()), kWithin * balance.dissipated);
}

TEST(EndLawTest, NeighboursInTheLanesDoNotSeeALaw) {
  // Rods with sprung clamps step beside one that rubs, and beside one that does not.
  RodModel sprung = Rubbing();
  sprung.a.laws.clear();
  sprung.b.laws.clear();
  const auto run = [&](const RodModel& other, int rods) {
    std::vector<Rod> all;
    all.push_back(Arch(other));
    for (int k = 1; k < rods; ++k) all.push_back(Arch(sprung));
    std::vector<Rod*> pointers;
    for (Rod& rod : all) pointers.push_back(&rod);
    RodBatch batch(pointers);
    for (int k = 1; k <= 60; ++k) {
      const Pose a = Shaken(kA, k), b = Shaken(kB, k);
      for (const SolveReport& report :
           batch.Step(1e-3, std::vector<RodDrive>(all.size(), RodDrive{&a, &b, nullptr})))
        EXPECT_TRUE(report.converged);
    }
    std::vector<double> neighbours;
    for (int k = 1; k < rods; ++k) {
      const std::vector<double> one = StateOf(all[k]);
      neighbours.insert(neighbours.end(), one.begin(), one.end());
    }
    return neighbours;
  };
  for (const int rods : {2, 4, 7}) EXPECT_EQ(run(Rubbing(), rods), run(sprung, rods)) << rods;
}

}  // namespace
}  // namespace cosserat_cable::rod
