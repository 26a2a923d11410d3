// Causes at the clamps and around the cable: air, damping, an added body, an obstacle, friction and
// play, each against a closed form, and all through what is common to them.
#include <gtest/gtest.h>

#include <random>

#include "cable/cable_cases.h"
#include "cable/cable_text.h"
#include "cosserat_cable/cable/cable_fleet.h"
#include "cosserat_cable/cable/cable_rod.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/initial_shape.h"
#include "cosserat_cable/rod/modes.h"
#include "cosserat_cable/rod/point_loads.h"
#include "rod/ringing.h"
#include "rod/rod_cases.h"
#include "tools/validation.h"

namespace cosserat_cable {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Numbers = std::map<std::string, double>;

constexpr double kLength = 0.2, kDiameter = 0.008, kRhoA = 0.09, kEI = 0.012;
const Vector3d kGravity(0, 0, -9.81);
const Pose kClamp;

CableModel Specimen(const std::vector<CableExtension>& extensions, double eta_EI = 1e-5) {
  CableModel m = RoundCableModel(kLength, kDiameter, kRhoA, kEI, 0.75 * kEI, eta_EI);
  m.extensions = extensions;
  return m;
}

/// Clamped at a, straight along z, without weight.
rod::RodModel Cantilever(const CableModel& cable) {
  rod::RodModel model = MakeRodModel(cable, Vector3d::Zero());
  model.b = rod::EndModel::Free();
  return model;
}

rod::Rod Straight(const rod::RodModel& model) {
  rod::Rod rod(model);
  rod.SetConfiguration(rod::StraightShape(kClamp, model.length, model.elements));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

// ---- Common to all ------------------------------------------------------------------------------

/// A cause as a file has it, at work; and with which numbers it is absent.
struct Cause {
  std::string name, text;
  Numbers zero;
};

const std::vector<Cause>& Causes() {
  static const std::vector<Cause> causes = {
      {"clamp_friction",
       "{a: {stuck: 0.5, slip_moment: 0.001, spring: 0.05}, b: {stuck: 0.25, slip_moment: 0.002, "
       "spring: 0.5}}",
       {{"a.stuck", 0.5}, {"a.slip_moment", 0}, {"a.spring", 0}}},
      {"clamp_play",
       "{a: {gap: 0.01, stiffness: 0.3}, b: {gap: 0.02, stiffness: 1.5}}",
       {{"a.gap", 0}, {"a.stiffness", 0.3}}},
      {"air_drag", "{Cd: 40}", {{"Cd", 0}}},
      {"external_damping", "{rate: 3}", {{"rate", 0}}},
      {"added_mass", "{s: 0.07, mass: 0.004}", {{"s", 0.07}, {"mass", 0}}},
      {"contact",
       "{plane: {azimuth: 0.25, elevation: -0.125, offset: -0.005}, stiffness: 500}",
       {{"plane.azimuth", 0}, {"plane.elevation", 0}, {"plane.offset", -0.005}, {"stiffness", 0}}},
      {"contact",
       "{peg: {x: 0.0075, y: -0.0625, z: 0.05, azimuth: 1.5, elevation: 0.125, radius: 0.002}}",
       {{"peg.x", 0},
        {"peg.y", 0},
        {"peg.z", -0.1},
        {"peg.azimuth", 0},
        {"peg.elevation", 0},
        {"peg.radius", 0.1},
        {"stiffness", 0}}}};
  return causes;
}

CableModel WithCause(const Cause& cause) {
  const CableModel read =
      LoadOne(std::string(kSpecimen) + "  extensions: {" + cause.name + ": " + cause.text + "}\n");
  return Specimen(read.extensions);
}

/// A hose that hangs in a U while both clamps are shaken and turned.
Surroundings Shaken(int step) {
  const double t = 1e-3 * step;
  Surroundings s;
  s.a.X.q = Quaterniond(0, 1, 0, 0) * AngleAxisd(0.2 * (1 - std::cos(40 * t)), Vector3d::UnitX());
  s.b.X = {{0.01 * (1 - std::cos(30 * t)), 0.1, 0.01 * (1 - std::cos(55 * t))},
           Quaterniond(AngleAxisd(0.3 * (1 - std::cos(35 * t)), Vector3d::UnitX()))};
  return s;
}

std::vector<double> StateOf(CableSimulation* cable) {
  std::vector<double> all;
  for (const Pose& node : cable->nodes())
    all.insert(all.end(), {node.p.x(), node.p.y(), node.p.z(), node.q.w(), node.q.x(), node.q.y(),
                           node.q.z()});
  const CableReport report = cable->Report();
  for (const Vector3d& v : {report.force_a, report.moment_a, report.force_b, report.moment_b})
    all.insert(all.end(), v.data(), v.data() + 3);
  all.insert(all.end(), {report.energy.work_ends, report.energy.dissipated, report.energy.stored});
  return all;
}

std::vector<double> StateAfter(const CableModel& model, int steps = 100) {
  CableSimulation cable(model, {}, kGravity);
  EXPECT_TRUE(cable.Settle(Shaken(0)).ok);
  for (int k = 1; k <= steps; ++k) EXPECT_TRUE(cable.Step(1e-3, Shaken(k)).ok) << k;
  return StateOf(&cable);
}

TEST(OutsideCauses, AreWrittenAndReadBackToTheSameBits) {
  for (const Cause& cause : Causes()) {
    const Loaded loaded =
        Load(std::string(kSpecimen) + "  extensions: {" + cause.name + ": " + cause.text + "}\n");
    EXPECT_EQ(loaded.said, "") << cause.name;
    const std::string text = WriteCableFile(loaded.file);
    const CableModel again = LoadOne(text);
    ASSERT_EQ(again.extensions.size(), 1u);
    EXPECT_EQ(again.extensions[0].parts, loaded.file.cables[0].extensions[0].parts) << text;
    EXPECT_NE(text.find(cause.name + ": " + cause.text), std::string::npos) << text;
  }
}

TEST(OutsideCauses, AtZeroAreNotThere) {
  const std::vector<double> baseline = StateAfter(Specimen({}));
  for (const Cause& cause : Causes()) {
    EXPECT_EQ(StateAfter(Specimen({{cause.name, {cause.zero}}})), baseline) << cause.name;
    EXPECT_NE(StateAfter(WithCause(cause)), baseline) << cause.name;
  }
}

TEST(OutsideCauses, BalanceTheEnergy) {
  constexpr double kWithin = 5e-3;  // of the energy dissipated; slips and impacts between steps
  for (const Cause& cause : Causes()) {
    CableSimulation cable(WithCause(cause), {}, kGravity);
    ASSERT_TRUE(cable.Settle(Shaken(0)).ok) << cause.name;
    for (int k = 1; k <= 4000; ++k) ASSERT_TRUE(cable.Step(2.5e-4, Shaken(0)).ok) << cause.name;
    const rod::EnergyBalance rest = cable.ReportForces().energy;
    EXPECT_NEAR(rest.dissipated, 0, 1e-9) << cause.name << " at rest";
    for (int k = 1; k <= 4000; ++k) {
      Surroundings now = Shaken(0);
      const double f = 0.5 * (1 - std::cos(2.5e-4 * k * 30));
      now.a.X.p.x() = 0.02 * f;
      now.a.X.q = now.a.X.q * AngleAxisd(0.1 * f, Vector3d::UnitX());
      ASSERT_TRUE(cable.Step(2.5e-4, now).ok) << cause.name;
    }
    const rod::EnergyBalance balance = cable.ReportForces().energy;
    EXPECT_GT(balance.dissipated, 1e-6) << cause.name;
    EXPECT_LT(std::abs(balance.Residual()), kWithin * balance.dissipated) << cause.name;
  }
}

TEST(OutsideCauses, LeaveTheirNeighboursInTheFleetAlone) {
  const std::vector<double> alone = StateAfter(Specimen({}), 0);
  const auto beside = [](const CableModel& other) {
    std::vector<CableSimulation> cables;
    for (int i = 0; i < 5; ++i)
      cables.emplace_back(i == 2 ? other : Specimen({}), std::vector<const Body*>{}, kGravity);
    std::vector<CableSimulation*> pointers;
    for (CableSimulation& cable : cables) {
      EXPECT_TRUE(cable.Settle(Shaken(0)).ok);
      pointers.push_back(&cable);
    }
    CableFleet fleet(pointers, 1);
    for (int k = 1; k <= 50; ++k) {
      const Surroundings then = Shaken(k);
      for (const StepOutcome& outcome :
           fleet.Step(1e-3, std::vector<const Surroundings*>(cables.size(), &then)))
        EXPECT_TRUE(outcome.ok) << outcome.message;
    }
    std::vector<double> all;
    for (const int i : {0, 1, 3, 4}) {
      const std::vector<double> one = StateOf(&cables[i]);
      all.insert(all.end(), one.begin(), one.end());
    }
    return all;
  };
  const std::vector<double> baseline = beside(Specimen({}));
  for (const Cause& cause : Causes()) EXPECT_EQ(beside(WithCause(cause)), baseline) << cause.name;
}

/// Nodes anywhere, moving anyhow.
class Scattered : public rod::Centreline {
 public:
  Scattered(int elements, double h, unsigned seed) {
    std::mt19937 rng(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    const auto vector = [&](double scale) {
      return Vec3<double>{scale * u(rng), scale * u(rng), scale * u(rng)};
    };
    for (int i = 0; i <= elements; ++i) {
      r.push_back(vector(0.3 * h) + Vec3<double>{0, 0, i * h});
      v.push_back(vector(1));
      Quaterniond one(u(rng), u(rng), u(rng), u(rng));
      one.normalize();
      q.push_back({one.w(), one.x(), one.y(), one.z()});
    }
  }
  int elements() const override { return static_cast<int>(r.size()) - 1; }
  Vec3<double> position(int i) const override { return r[i]; }
  Vec3<double> velocity(int i) const override { return v[i]; }
  Quat<double> orientation(int i) const override { return q[i]; }

  std::vector<Vec3<double>> r, v;
  std::vector<Quat<double>> q;
};

/// Forces on nodes and their derivatives by the nodes' positions and velocities.
class Collected : public rod::LoadSink {
 public:
  explicit Collected(int elements)
      : force(Eigen::VectorXd::Zero(3 * (elements + 1))),
        by_position(Eigen::MatrixXd::Zero(force.size(), force.size())),
        by_velocity(by_position) {}
  void AddForce(int element, double xi, const Vec3<double>& f, const Mat3<double>& K,
                const Mat3<double>& C) override {
    const double weight[] = {1 - xi, xi};
    for (int a = 0; a < 2; ++a) {
      force.segment<3>(3 * (element + a)) += weight[a] * ToEigen(f);
      for (int b = 0; b < 2; ++b) Add(element + a, element + b, weight[a] * weight[b], K, C);
    }
  }
  void AddNodeForce(int node, const Vec3<double>& f, const Mat3<double>& K,
                    const Mat3<double>& C) override {
    force.segment<3>(3 * node) += ToEigen(f);
    Add(node, node, 1, K, C);
  }
  void AddMoment(int, const Vec3<double>&) override {}
  void AddDissipation(double power) override { dissipation += power; }

  Eigen::VectorXd force;
  Eigen::MatrixXd by_position, by_velocity;
  double dissipation = 0;

 private:
  void Add(int i, int j, double weight, const Mat3<double>& K, const Mat3<double>& C) {
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        by_position(3 * i + a, 3 * j + b) += weight * K[a][b];
        by_velocity(3 * i + a, 3 * j + b) += weight * C[a][b];
      }
  }
};

TEST(OutsideCauses, LoadsTellTheirDerivatives) {
  // Central differences of 1e-7 m and 1e-6 m/s. Contact leaves out how its closing speed changes
  // with the direction of the normal: at rest there is none.
  constexpr double kRelative = 1e-5;
  std::vector<Cause> loads(Causes().begin() + 2, Causes().end());
  loads[3].text = "{plane: {azimuth: 0.25, elevation: -0.125, offset: 0.001}, stiffness: 500}";
  loads[4].text =
      "{peg: {x: 0.001, y: 0.01, z: 0.07, azimuth: 1.5, elevation: 0.125, radius: 0.003}}";
  for (const Cause& cause : loads) {
    CableModel cable = WithCause(cause);
    cable.elements = 10;
    cable.contact.smoothing = 2e-3;  // so that no difference crosses an edge of the band
    const rod::RodModel model = MakeRodModel(cable, kGravity);
    if (cause.name == "added_mass") continue;
    ASSERT_EQ(model.loads.size(), 1u) << cause.name;
    const rod::Load& load = *model.loads.front();
    EXPECT_EQ(load.ActsAtRest(), cause.name == "contact");
    double most = 0;
    for (unsigned seed = 1; seed <= 5; ++seed) {
      Scattered rod(10, kLength / 10, seed);
      const bool contact = cause.name == "contact";
      if (contact) std::fill(rod.v.begin(), rod.v.end(), Vec3<double>{});
      const auto forces = [&] {
        Collected sink(10);
        load.Evaluate(rod, &sink);
        return sink;
      };
      const Collected at = forces();
      most = std::max(most, at.force.norm());
      const auto difference = [&](double* x, double step) -> Eigen::VectorXd {
        const double before = *x;
        *x = before + step;
        const Eigen::VectorXd up = forces().force;
        *x = before - step;
        const Eigen::VectorXd down = forces().force;
        *x = before;
        return (up - down) / (2 * step);
      };
      for (int i = 0; i <= 10; ++i)
        for (int k = 0; k < 3; ++k) {
          const auto component = [k](Vec3<double>* a) {
            return k == 0 ? &a->x : k == 1 ? &a->y : &a->z;
          };
          const Eigen::VectorXd K = difference(component(&rod.r[i]), 1e-7);
          const Eigen::VectorXd C = difference(component(&rod.v[i]), 1e-6);
          EXPECT_LT((K - at.by_position.col(3 * i + k)).norm(),
                    kRelative * (1 + at.by_position.norm()))
              << cause.text;
          EXPECT_LT((C - at.by_velocity.col(3 * i + k)).norm(),
                    kRelative * (1 + at.by_velocity.norm()))
              << cause.text;
        }
      EXPECT_EQ(at.by_position, at.by_position.transpose());
      EXPECT_EQ(at.by_velocity, at.by_velocity.transpose());
      // What is lost is what the forces take; of contact at rest nothing.
      double power = 0;
      for (int i = 0; i <= 10; ++i) power += at.force.segment<3>(3 * i).dot(ToEigen(rod.v[i]));
      EXPECT_NEAR(at.dissipation, -power, 1e-12 * (1 + std::abs(power))) << cause.text;
    }
    EXPECT_GT(most, 0) << cause.text;
  }
}

// ---- Closed forms -------------------------------------------------------------------------------

TEST(ExternalDamping, DecaysAsItsRateWhateverTheMode) {
  constexpr double kRate = 6;
  // Sections that turn have inertia of their own, which no external damping sees: of the second
  // modes a part (4.69 d/(4 L))^2 = 2e-3.
  constexpr double kOfModes = 5e-3, kOfMotion = 5e-3;
  rod::Rod rod = Straight(Cantilever(Specimen({{"external_damping", {{{"rate", kRate}}}}}, 0)));
  const rod::Rod plain = Straight(Cantilever(Specimen({}, 0)));
  const std::vector<rod::Mode> modes = rod::FindModes(rod, 4), undamped = rod::FindModes(plain, 4);
  for (int n = 0; n < 4; ++n)
    EXPECT_NEAR(modes[n].zeta - undamped[n].zeta, 0.5 * kRate / modes[n].w,
                kOfModes * 0.5 * kRate / modes[n].w)
        << n;
  for (const int n : {0, 2}) {  // the first and second across one direction
    rod::Rod swinging(rod);
    std::vector<Vector3d> v, omega;
    int axis;
    modes[n].displacement.back().cwiseAbs().maxCoeff(&axis);
    for (int i = 0; i <= swinging.elements(); ++i) {
      v.push_back(1e-4 * modes[n].w * modes[n].displacement[i]);
      omega.push_back(1e-4 * modes[n].w * modes[n].rotation[i]);
    }
    swinging.SetVelocities(v, omega);
    const double dt = 2 * M_PI / modes[n].w / 100;
    std::vector<double> tip;
    for (int k = 0; k < 1000; ++k) {
      ASSERT_TRUE(swinging.Step(dt, kClamp, kClamp).converged);
      tip.push_back(swinging.pose(swinging.elements()).p[axis]);
    }
    Validate({"Causes", "external_damping: decay of bending mode " + Shown(n / 2 + 1) + " [1/s]",
              "c/2, whatever the mode", 0.5 * kRate, rod::Listen(tip, dt).delta,
              kOfMotion * 0.5 * kRate, swinging.elements(), dt});
  }
}

TEST(AirDrag, MakesOneOverTheAmplitudeGrowLinearly) {
  // With w = q(t) phi(s): q'' + w^2 q = -beta |q'| q', beta = rho Cd d/2 int |phi|^3 / (rhoA int
  // phi^2); averaged over a cycle, 1/A = 1/A0 + 4/(3 pi) beta w t.
  constexpr double kCd = 15, kAirDensity = 1.204, kStart = 4e-3;  // [m] at the tip
  constexpr double kRelative = 0.01;  // averaging: beta A = 0.01; the tip moves on an arc
  CableModel cable = Specimen({{"air_drag", {{{"Cd", kCd}}}}}, 0);
  cable.mass_per_length = 0.02;
  rod::Rod rod = Straight(Cantilever(cable));
  double cubes = 0, squares = 0;
  constexpr int kParts = 1000;
  for (int k = 0; k < kParts; ++k) {
    const double phi = 0.5 * rod::CantileverMode((k + 0.5) / kParts);
    cubes += phi * phi * phi / kParts;
    squares += phi * phi / kParts;
  }
  const double beta =
      0.5 * kAirDensity * kCd * kDiameter * cubes / (cable.mass_per_length * squares);
  const rod::Mode mode = rod::FindModes(rod, 1).front();
  std::vector<Vector3d> v, omega;
  for (int i = 0; i <= rod.elements(); ++i) {
    v.push_back(kStart * mode.w * mode.displacement[i]);
    omega.push_back(kStart * mode.w * mode.rotation[i]);
  }
  rod.SetVelocities(v, omega);
  const Vector3d along = mode.displacement.back().normalized();
  const double dt = 2 * M_PI / mode.w / 200;
  std::vector<double> tip;
  for (int k = 0; k < 4000; ++k) {
    ASSERT_TRUE(rod.Step(dt, kClamp, kClamp).converged);
    tip.push_back(along.dot(rod.pose(rod.elements()).p));
  }
  std::vector<double> inverse, times;
  for (std::size_t k = 1; k + 1 < tip.size(); ++k)
    if ((tip[k] - tip[k - 1]) * (tip[k + 1] - tip[k]) < 0) {
      const double curvature = tip[k - 1] - 2 * tip[k] + tip[k + 1];
      const double slope = 0.5 * (tip[k + 1] - tip[k - 1]);
      inverse.push_back(1 / std::abs(tip[k] - 0.5 * slope * slope / curvature));
      times.push_back(k * dt);
    }
  ASSERT_GE(inverse.size(), 38u);
  EXPECT_GT(inverse.back(), 1.4 * inverse.front());
  const double expected = 4 / (3 * M_PI) * beta * mode.w;
  const std::size_t middle = inverse.size() / 2, last = inverse.size() - 1;
  const auto slope = [&](std::size_t i, std::size_t j) {
    return (inverse[j] - inverse[i]) / (times[j] - times[i]);
  };
  Validate({"Causes", "air_drag: growth of 1/amplitude [1/(m s)]",
            "4/(3 pi) beta w, averaged over a cycle", expected, slope(0, last),
            kRelative * expected, rod.elements(), dt});
  EXPECT_NEAR(slope(0, middle), slope(middle, last), 2 * kRelative * expected) << "it is a line";
}

TEST(AirDrag, LeavesMotionAlongTheCableAlone) {
  constexpr double kTolerance = 1e-12;
  const CableModel cable = Specimen({{"air_drag", {{{"Cd", 10}}}}});
  rod::Rod rod = Straight(Cantilever(cable));
  Motion along;
  along.v.z() = 3;
  rod.AddRigidMotion(along);
  Collected sink(rod.elements());
  rod.model().loads.front()->Evaluate(rod, &sink);
  EXPECT_LT(sink.force.norm(), kTolerance);
  along.v = {0, -2, 0};
  rod.AddRigidMotion(along);
  Collected across(rod.elements());
  rod.model().loads.front()->Evaluate(rod, &across);
  double sum = 0;
  for (int i = 0; i <= rod.elements(); ++i) sum += across.force[3 * i + 1];
  EXPECT_NEAR(sum, 0.5 * 1.204 * 10 * kDiameter * kLength * 4, kTolerance);
}

TEST(AddedMass, SwingsAtTheTipAsRayleighSays) {
  // w^2 = 3 EI/(L^3 (m + 0.2357 rhoA L)): high by less than 0.1 % with so heavy a tip.
  constexpr double kRelative = 2e-3, kMass = 0.05;
  const rod::Rod rod =
      Straight(Cantilever(Specimen({{"added_mass", {{{"s", kLength}, {"mass", kMass}}}}}, 0)));
  const double w = std::sqrt(3 * kEI / (std::pow(kLength, 3) * (kMass + 0.2357 * kRhoA * kLength)));
  Validate({"Causes", "added_mass: w of a cantilever with a mass at its tip [rad/s]",
            "Rayleigh, 3 EI/(L^3 (m + 0.2357 rhoA L))", w, rod::FindModes(rod, 1).front().w,
            kRelative * w, rod.elements()});
}

TEST(AddedMass, LowersAFrequencyByItsPlaceInTheMode) {
  // Rayleigh: dw/w = -m phi(s)^2 / (2 rhoA int phi^2).
  constexpr double kRelative = 0.01, kMass = 1e-5;
  const double plain = rod::FindModes(Straight(Cantilever(Specimen({}, 0))), 1).front().w;
  for (const double x : {0.35, 0.6, 0.9}) {
    const rod::Rod rod = Straight(
        Cantilever(Specimen({{"added_mass", {{{"s", x * kLength}, {"mass", kMass}}}}}, 0)));
    const double phi = rod::CantileverMode(x);  // of which the mean square is 1
    const double shift = kMass * phi * phi / (2 * kRhoA * kLength);
    Validate({"Causes", "added_mass: shift of w by a small mass at " + Shown(x) + " L, relative",
              "Rayleigh, m phi^2/(2 rhoA L mean phi^2)", shift,
              1 - rod::FindModes(rod, 1).front().w / plain, kRelative * shift, rod.elements()});
  }
}

/// A cantilever that a force P pulls along x at its tip, onto a peg beside it.
class OnAPeg : public ::testing::Test {
 protected:
  static constexpr double kPlace = 0.1, kAway = 5e-4, kRadius = 0.002, kStiffness = 2e4;

  CableModel Cable() const {
    CableModel cable = Specimen({{"contact",
                                  {{{"peg.x", 0.5 * kDiameter + kRadius + kAway},
                                    {"peg.y", 0},
                                    {"peg.z", kPlace},
                                    {"peg.azimuth", M_PI / 2},
                                    {"peg.elevation", 0},
                                    {"peg.radius", kRadius},
                                    {"stiffness", kStiffness}}}}});
    cable.elements = 50;             // sites at 4 mm: one is at the peg
    cable.contact.smoothing = 1e-7;  // much less than it sinks in
    return cable;
  }
  /// Of the free cantilever at the peg, by a unit force at the tip; EI and shear.
  static double Compliance(double GA) {
    return kPlace * kPlace * (3 * kLength - kPlace) / (6 * kEI) + kPlace / GA;
  }
};

TEST_F(OnAPeg, ItIsPushedBackAsABeamIs) {
  const CableModel cable = Cable();
  const double own = std::pow(kPlace, 3) / (3 * kEI) + kPlace / cable.GA1 + 1 / kStiffness;
  constexpr double kRelative = 2e-3;  // arcs of 1 mm at the tip; elements
  rod::Rod rod = Straight(Cantilever(cable)), plain = Straight(Cantilever([&] {
                                                CableModel without = cable;
                                                without.extensions.clear();
                                                return without;
                                              }()));
  const double onset = kAway / Compliance(cable.GA1);
  std::vector<double> pulls, pushes;
  for (const double of_onset : {0.5, 0.9, 2.0, 4.0}) {
    const double P = of_onset * onset;
    const rod::PointLoads pull(kLength, {{kLength, {P, 0, 0}}});
    ASSERT_TRUE(rod.Equilibrate(&pull).converged);
    ASSERT_TRUE(plain.Equilibrate(&pull).converged);
    const double R = (P * Compliance(cable.GA1) - kAway) / own;
    if (of_onset < 1)
      EXPECT_EQ(rod.pose(50).p, plain.pose(50).p);
    else
      Validate({"Causes",
                "contact: force of a peg at " + Shown(of_onset) + " times the pull of onset [N]",
                "superposed cantilevers", R, P + rod.reaction_a().force.x(), kRelative * R, 50});
    pulls.push_back(P);
    pushes.push_back(P + rod.reaction_a().force.x());
  }
  // Where the line through the last two begins.
  const double begins = pulls[2] - pushes[2] * (pulls[3] - pulls[2]) / (pushes[3] - pushes[2]);
  Validate({"Causes", "contact: pull at which a cantilever reaches a peg [N]", "cantilever", onset,
            begins, kRelative * onset, 50});
}

TEST_F(OnAPeg, ThePegGoesWithTheClamp) {
  constexpr double kTolerance = 1e-8;  // [N]
  const CableModel cable = Cable();
  const rod::PointLoads pull(kLength, {{kLength, {0.1, 0, 0}}});
  rod::Rod rod = Straight(Cantilever(cable));
  ASSERT_TRUE(rod.Equilibrate(&pull).converged);
  const Pose X{{1, -2, 0.5}, Quaterniond(0.5, -0.5, 0.5, 0.5)};
  const rod::PointLoads turned(kLength, {{kLength, X.q * Vector3d(0.1, 0, 0)}});
  rod::Rod moved(Cantilever(cable));
  moved.SetConfiguration(rod::StraightShape(X, kLength, cable.elements));
  ASSERT_TRUE(moved.Equilibrate(&turned).converged);
  EXPECT_LT((moved.reaction_a().force - X.q * rod.reaction_a().force).norm(), kTolerance);
  EXPECT_GT((rod.reaction_a().force + Vector3d(0.1, 0, 0)).norm(), 0.01);
  // Clamp and all at a constant speed: nothing happens.
  Motion along;
  along.v = {3, 0, 1};
  rod.AddRigidMotion(along);
  const Vector3d before = rod.reaction_a().force;
  for (int k = 1; k <= 50; ++k) {
    const Pose a{1e-3 * k * along.v, Quaterniond::Identity()};
    ASSERT_TRUE(rod.Step(1e-3, a, a, &pull).converged);
  }
  EXPECT_LT((rod.reaction_a().force - before).norm(), 1e-6);
}

TEST_F(OnAPeg, VibratesAsABeamThatIsPropped) {
  // Pressed on the peg, the first mode of the part beyond and before is much higher than the
  // cantilever's, and as for a stiffer clamp of contact: between free and held there.
  CableModel cable = Cable();
  rod::Rod rod = Straight(Cantilever(cable));
  const rod::PointLoads pull(kLength, {{kLength, {0.1, 0, 0}}});
  ASSERT_TRUE(rod.Equilibrate(&pull).converged);
  const std::vector<rod::Mode> modes = rod::FindModes(rod, 2, &pull);
  const double plain = rod::FindModes(Straight(Cantilever(Specimen({}))), 1).front().w;
  // Across the push it is the cantilever still, with it the propped one.
  EXPECT_NEAR(modes[0].w, plain, 0.01 * plain);
  EXPECT_GT(modes[1].w, 1.5 * plain);
}

TEST(ContactCause, APlaneMeetsTheTipOfAFreeEnd) {
  // A plane that leans towards the tip and is 1 mm too near bends the cantilever as a force at its
  // very end does.
  constexpr double kDepth = 1e-3, kLean = 0.1;
  constexpr double kRelative = 5e-3;  // elements; a diameter short of the tip it would be 12 %
  CableModel cable =
      Specimen({{"contact",
                 {{{"plane.azimuth", 0},
                   {"plane.elevation", -kLean},
                   {"plane.offset", kDepth - 0.5 * kDiameter - kLength * std::sin(kLean)},
                   {"stiffness", 1e6}}}}});
  cable.contact.smoothing = 1e-7;
  rod::Rod rod = Straight(Cantilever(cable));
  ASSERT_TRUE(rod.Equilibrate().converged);
  const double compliance = std::pow(kLength, 3) / (3 * kEI) + kLength / cable.GA1;
  const double force = kDepth / std::cos(kLean) / compliance;
  EXPECT_NEAR(-rod.reaction_a().force.x(), force, kRelative * force);
}

TEST(ContactCause, APlaneHoldsWhatHangsOnIt) {
  // A hose in a U over a floor 5 mm above its lowest point: it lies there, and the clamps carry
  // what the floor does not.
  constexpr double kHigher = 5e-3, kSunk = 5e-4;  // [m]: what it may sink in by its weight
  CableModel cable = Specimen({});
  Surroundings s;
  s.a.X = rod::Facing({0, 0, 0}, -Vector3d::UnitZ());
  s.b.X = rod::Facing({0, 0.1, 0}, Vector3d::UnitZ());
  const auto settle = [&](CableSimulation* simulation) {
    EXPECT_TRUE(simulation->Settle(s).ok);
    double lowest = 0;
    for (const Pose& node : simulation->nodes()) lowest = std::min(lowest, node.p.z());
    return lowest;
  };
  CableSimulation hanging(cable, {}, kGravity);
  const double floor = settle(&hanging) + kHigher;
  // Clamp a's z axis points down.
  cable.extensions = {{"contact",
                       {{{"plane.azimuth", 0},
                         {"plane.elevation", -M_PI / 2},
                         {"plane.offset", floor - 0.5 * kDiameter}}}}};
  CableSimulation lying(cable, {}, kGravity);
  EXPECT_NEAR(settle(&lying), floor, kSunk);
  for (int k = 0; k < 50; ++k) ASSERT_TRUE(lying.Step(1e-3, s).ok);
  const CableReport report = lying.Report(), free = hanging.Report();
  const double weight = kRhoA * kLength * 9.81;
  EXPECT_NEAR(free.force_a.z() + free.force_b.z(), weight, 1e-6 * weight);
  EXPECT_LT(report.force_a.z() + report.force_b.z(), 0.9 * weight);
  EXPECT_NEAR(report.energy.dissipated, 0, 1e-9) << "it lies still";
}

}  // namespace
}  // namespace cosserat_cable
