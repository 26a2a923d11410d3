// Extensions of a cable: their keys, and what they do to a cable against closed forms.
#include <gtest/gtest.h>

#include <complex>

#include "cable/cable_cases.h"
#include "cable/cable_text.h"
#include "cosserat_cable/cable/cable_simulation.h"
#include "cosserat_cable/cable/extension_number.h"
#include "cosserat_cable/math/rotation.h"
#include "cosserat_cable/rod/initial_shape.h"
#include "cosserat_cable/rod/rod.h"

namespace cosserat_cable {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Complex = std::complex<double>;
using Numbers = std::map<std::string, double>;

// ---- Keys ---------------------------------------------------------------------------------------

constexpr const char* kAllThree =
    "  extensions:\n"
    "    maxwell:\n"
    "      - {tau: 0.05, EI: 0.002, GJ: 0.001}\n"
    "      - {tau: 0.5, EI1: 0.003, EI2: 0.004, EA: 100}\n"
    "    clamp_compliance: {a: {bending: 5, torsion: 20}, b: {bending: 6}}\n"
    "    clamp_damping: {a: {bending: 1.0e-4}}\n";

TEST(Extensions, TakeWhatIsGivenAndFillInTheRest) {
  const CableModel cable = LoadOne(std::string(kSpecimen) + kAllThree);
  ASSERT_EQ(cable.extensions.size(), 3u);
  const CableExtension& maxwell = cable.extensions[0];
  EXPECT_EQ(maxwell.name, "maxwell");
  ASSERT_EQ(maxwell.parts.size(), 2u);
  EXPECT_EQ(maxwell.parts[0],
            (Numbers{{"tau", 0.05}, {"EI1", 0.002}, {"EI2", 0.002}, {"GJ", 0.001}, {"EA", 0}}));
  EXPECT_EQ(maxwell.parts[1],
            (Numbers{{"tau", 0.5}, {"EI1", 0.003}, {"EI2", 0.004}, {"GJ", 0}, {"EA", 100}}));
  EXPECT_EQ(cable.extensions[1].name, "clamp_compliance");
  // What is left out stays rigid.
  EXPECT_EQ(cable.extensions[1].parts,
            (std::vector<Numbers>{{{"a.bending", 5}, {"a.torsion", 20}, {"b.bending", 6}}}));
  EXPECT_EQ(cable.extensions[2].name, "clamp_damping");
  EXPECT_EQ(cable.extensions[2].parts, (std::vector<Numbers>{{{"a.bending", 1e-4}}}));
}

TEST(Extensions, AreWrittenAndReadBackToTheSameBits) {
  const Loaded loaded =
      Load(Replaced(std::string(kSpecimen) + kAllThree, "0.05", "0.1234567891234567"));
  const std::string text = WriteCableFile(loaded.file);
  const CableModel cable = LoadOne(text);
  ASSERT_EQ(cable.extensions.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(cable.extensions[i].name, loaded.file.cables[0].extensions[i].name);
    EXPECT_EQ(cable.extensions[i].parts, loaded.file.cables[0].extensions[i].parts) << text;
  }
  EXPECT_EQ(WriteCableFile(Load(text).file), text);
  EXPECT_NE(WriteCableFile(Load(kSpecimen).file).find("extensions: {}"), std::string::npos);
}

TEST(Extensions, OfATypeAreTakenUnlessTheCableSaysItsOwn) {
  const std::string type = Replaced(Vehicle(""), "eta_EI: 2.0e-4",
                                    "eta_EI: 2.0e-4, extensions: {maxwell: [{tau: 1, EI: 0.1}]}");
  const auto with = [&](const std::string& keys) {
    const CableModel cable = LoadOne(type + "  - name: one\n    type: hose\n" + keys + kClamps);
    return cable.extensions;
  };
  ASSERT_EQ(with("").size(), 1u);
  EXPECT_EQ(with("")[0].name, "maxwell");
  EXPECT_TRUE(with("    extensions: {}\n").empty());
  const auto own = with("    extensions: {clamp_compliance: {a: {torsion: 3}}}\n");
  ASSERT_EQ(own.size(), 1u);
  EXPECT_EQ(own[0].name, "clamp_compliance");
}

TEST(Extensions, ThatAreUnknownGetTheNearestName) {
  EXPECT_EQ(SaidWith("  extensions: {clamp_complience: {a: {bending: 1}}}\n"),
            "f:9: cable.extensions.clamp_complience: got an unknown key, did you mean "
            "'clamp_compliance'?\n");
  EXPECT_EQ(SaidWith("  extensions: {sunshine: 1}\n"),
            "f:9: cable.extensions.sunshine: got an unknown key, expected one of maxwell, "
            "clamp_compliance, clamp_damping, clamp_friction, clamp_play, air_drag, "
            "external_damping, added_mass, contact\n");
  EXPECT_EQ(SaidWith("  extensions: maxwell\n"),
            "f:9: cable.extensions: got 'maxwell', expected a map of extensions by name\n");
  EXPECT_EQ(SaidWith("  extensions:\n"), "");
}

TEST(Extensions, ReportWrongBranches) {
  EXPECT_EQ(SaidWith("  extensions:\n"
                     "    maxwell:\n"
                     "      - {tau: 0, EI: 0.002}\n"
                     "      - {EI: -1, GJ: 1e9}\n"
                     "      - {tau: 1}\n"
                     "      - {tau: 1, EI1: 0.1, EJ: 1}\n"
                     "      - 5\n"),
            "f:11: cable.extensions.maxwell[0].tau: got 0, expected a number in (0, 1e+06] [s]\n"
            "f:12: cable.extensions.maxwell[1].tau: missing, expected a number in (0, 1e+06] [s]\n"
            "f:12: cable.extensions.maxwell[1].EI: got -1, expected a number in [0, 100000] [N "
            "m^2]\n"
            "f:12: cable.extensions.maxwell[1].GJ: got 1e9, expected a number in [0, 100000] [N "
            "m^2]: is it in N mm^2?\n"
            "f:13: cable.extensions.maxwell[2]: got nothing that acts, expected at least one of "
            "EI, GJ, EA\n"
            "f:14: cable.extensions.maxwell[3].EI1: got this alone, expected EI1 and EI2, or EI\n"
            "f:14: cable.extensions.maxwell[3].EJ: got an unknown key, did you mean 'EI'?\n"
            "f:15: cable.extensions.maxwell[4]: got 5, expected a branch {tau: ..., EI: ...}\n");
  EXPECT_EQ(SaidWith("  extensions: {maxwell: {tau: 1, EI: 1}}\n"),
            "f:9: cable.extensions.maxwell: got a map, expected a list, each item a branch {tau: "
            "..., EI: ...}\n");
  EXPECT_EQ(SaidWith("  extensions: {maxwell: []}\n"),
            "f:9: cable.extensions.maxwell: got a list of 0, expected a list, each item a branch "
            "{tau: ..., EI: ...}\n");
}

TEST(Extensions, ReportWrongClamps) {
  EXPECT_EQ(
      SaidWith("  extensions:\n"
               "    clamp_compliance:\n"
               "      a: {bending: 0, torsoin: 2}\n"
               "      c: {bending: 1}\n"),
      "f:11: cable.extensions.clamp_compliance.a.bending: got 0, expected a number in (0, 1e+09] "
      "[N m/rad]\n"
      "f:11: cable.extensions.clamp_compliance.a.torsoin: got an unknown key, did you mean "
      "'torsion'?\n"
      "f:12: cable.extensions.clamp_compliance.c: got an unknown key, expected one of a, b\n");
  EXPECT_EQ(SaidWith("  extensions: {clamp_compliance: {a: 5}}\n"),
            "f:9: cable.extensions.clamp_compliance.a: got 5, expected a map of keys\n");
  EXPECT_EQ(SaidWith("  extensions: {clamp_compliance: {a: {}}}\n"),
            "f:9: cable.extensions.clamp_compliance: got nothing that acts, expected at least one "
            "of a.bending, a.torsion, b.bending, b.torsion\n");
  EXPECT_EQ(SaidWith("  extensions: {clamp_compliance:}\n"),
            "f:9: cable.extensions.clamp_compliance: got nothing, expected clamps {a: {bending: "
            "..., torsion: ...}, b: ...}\n");
}

TEST(Extensions, RefuseALossInARigidClamp) {
  EXPECT_EQ(SaidWith("  extensions:\n"
                     "    clamp_damping:\n"
                     "      a: {bending: 1e-4,\n"
                     "          torsion: 1e-4}\n"
                     "      b: {bending: 1e-4}\n"
                     "    clamp_compliance: {a: {bending: 2}, b: {torsion: 2}}\n"),
            "f:12: cable.extensions.clamp_damping.a.torsion: got a loss where the clamp is rigid, "
            "expected the stiffness with which it gives way in clamp_compliance: a.torsion\n"
            "f:13: cable.extensions.clamp_damping.b.bending: got a loss where the clamp is rigid, "
            "expected the stiffness with which it gives way in clamp_compliance: b.bending\n");
}

TEST(Extensions, HaveNumbersThatIdentificationMayAdjust) {
  const std::string cable = std::string(kSpecimen) + kAllThree + "  uncertain:\n";
  EXPECT_EQ(LoadOne(cable + "    - EI\n"
                            "    - extensions.maxwell[1].EI2\n"
                            "    - extensions.maxwell[0].EI\n"
                            "    - extensions.clamp_compliance.a.torsion\n")
                .uncertain,
            (std::vector<std::string>{"EI", "extensions.maxwell[1].EI2", "extensions.maxwell[0].EI",
                                      "extensions.clamp_compliance.a.torsion"}));
  EXPECT_EQ(
      Load(cable + "    - extensions.maxwell[2].EI\n"
                   "    - extensions.clamp_damping.b.bending\n"
                   "    - extensions\n")
          .said,
      "f:16: cable.uncertain[0]: got 'extensions.maxwell[2].EI', expected a number of the "
      "cable's extensions: did you mean 'extensions.maxwell[0].EI'?\n"
      "f:17: cable.uncertain[1]: got 'extensions.clamp_damping.b.bending', expected a number "
      "of the cable's extensions: did you mean 'extensions.clamp_damping.a.bending'?\n"
      "f:18: cable.uncertain[2]: got 'extensions', expected one of length, diameter, "
      "mass_per_length, EI, EI1, EI2, GJ, EA, GA, GA1, GA2, eta_EI, eta_EI1, eta_EI2, eta_GJ, "
      "eta_EA, eta_GA, eta_GA1, eta_GA2, disc.inertia, D_E\n");
}

TEST(Extensions, GiveTheirNumbersByThePathsOfTheFile) {
  std::vector<ExtensionKey> keys;
  for (const CableExtension& one : LoadOne(std::string(kSpecimen) + kAllThree).extensions) {
    keys.emplace_back();
    keys.back().extension = one;
  }
  const auto numbers = [&](const std::string& name) {
    std::vector<double> values;
    if (const auto found = FindExtensionNumber("extensions." + name, &keys))
      for (const double* value : found->values) values.push_back(*value);
    return values;
  };
  using Values = std::vector<double>;
  EXPECT_EQ(numbers("maxwell[0].tau"), Values{0.05});
  EXPECT_EQ(numbers("maxwell[0].EI"), (Values{0.002, 0.002}));
  EXPECT_EQ(numbers("maxwell[1].EI"), (Values{0.003, 0.004}));
  EXPECT_EQ(numbers("maxwell[1].EI2"), Values{0.004});
  EXPECT_EQ(numbers("clamp_damping.a.bending"), Values{1e-4});
  for (const char* none :
       {"maxwell[2].EI", "maxwell.EI", "maxwell[0].EJ", "clamp_damping.b.bending",
        "clamp_damping[0].a.bending", "maxwell[0]", ""})
    EXPECT_TRUE(numbers(none).empty()) << none;
  for (const auto& [name, unit] : {std::pair<const char*, const char*>{"maxwell[0].tau", "s"},
                                   {"maxwell[12].EI", "N m^2"},
                                   {"maxwell[0].EI2", "N m^2"},
                                   {"maxwell[0].GJ", "N m^2"},
                                   {"maxwell[0].EA", "N"},
                                   {"clamp_compliance.a.bending", "N m/rad"},
                                   {"clamp_damping.b.torsion", "N m s/rad"},
                                   {"sunshine.a", ""}})
    EXPECT_EQ(ExtensionNumberUnit(std::string("extensions.") + name), unit) << name;
}

TEST(Extensions, ThatDoNotExistCannotBeSimulated) {
  CableModel cable = RoundCableModel(0.2, 0.008, 0.09, 0.012, 0.009, 1e-4);
  cable.extensions = {{"sunshine", {}}};
  EXPECT_THROW(CableSimulation(cable, {}, Vector3d::Zero()), std::invalid_argument);
}

// ---- Physics ------------------------------------------------------------------------------------

constexpr double kLength = 0.2, kEI = 0.012, kGJ = 0.009;
const Vector3d kGravity(0, 0, -9.81);

CableModel Specimen(const std::vector<CableExtension>& extensions) {
  CableModel m = RoundCableModel(kLength, 0.008, 0.09, kEI, kGJ, 1e-5);
  m.extensions = extensions;
  return m;
}

/// Swings at 1.3 kHz, over after a few milliseconds, and its own viscosity is as small as that
/// lets.
void LetRodFollowAtOnce(CableModel* model) {
  model->mass_per_length = 1e-3;
  model->eta_GJ = 2e-7;
}

/// Straight along z, clamps turned by rotation vectors in their own frames [rad].
Surroundings Turned(const Vector3d& a, const Vector3d& b) {
  Surroundings s;
  s.a.X.q = RotationExp(a);
  s.b.X = {{0, 0, kLength}, RotationExp(b)};
  return s;
}

TEST(ClampCompliance, GivesWayToTwist) {
  constexpr double kRelative = 1e-9;  // linear: Newton's last correction
  constexpr double kAngle = 0.3, ka = 0.05, kb = 0.1;
  CableSimulation cable(Specimen({{"clamp_compliance", {{{"a.torsion", ka}, {"b.torsion", kb}}}}}),
                        {}, Vector3d::Zero());
  ASSERT_TRUE(cable.Settle(Turned({0, 0, 0}, {0, 0, kAngle})).ok);
  const double moment = kAngle / (kLength / kGJ + 1 / ka + 1 / kb);
  const CableReport report = cable.Report();
  EXPECT_NEAR(report.moment_b.z(), moment, kRelative * moment);
  EXPECT_NEAR(report.moment_a.z(), -moment, kRelative * moment);
  EXPECT_NEAR(RotationLog(cable.nodes().front().q).z(), moment / ka, kRelative * kAngle);
}

TEST(ClampCompliance, GivesWayToBending) {
  // Slopes phi of a Timoshenko beam with springs at its ends, whose clamps are turned by theta.
  constexpr double kRelative = 1e-4;  // elements: 40^-2/6
  constexpr double ka = 0.05, kb = 0.2, kThetaA = 2e-5, kThetaB = -1e-5;
  const CableModel model =
      Specimen({{"clamp_compliance", {{{"a.bending", ka}, {"b.bending", kb}}}}});
  CableSimulation cable(model, {}, Vector3d::Zero());
  ASSERT_TRUE(cable.Settle(Turned({kThetaA, 0, 0}, {kThetaB, 0, 0})).ok);
  const double shear = 12 * kEI / (model.GA1 * kLength * kLength);
  const double near = (4 + shear) / (1 + shear) * kEI / kLength;
  const double far = (2 - shear) / (1 + shear) * kEI / kLength;
  Eigen::Matrix2d stiffness;
  stiffness << near + ka, far, far, near + kb;
  const Eigen::Vector2d phi = stiffness.inverse() * Eigen::Vector2d(ka * kThetaA, kb * kThetaB);
  const CableReport report = cable.Report();
  EXPECT_NEAR(report.moment_a.x(), ka * (kThetaA - phi[0]), kRelative * ka * kThetaA);
  EXPECT_NEAR(report.moment_b.x(), kb * (kThetaB - phi[1]), kRelative * ka * kThetaA);
  // Torsion was left out and is rigid.
  EXPECT_NEAR(RotationLog(cable.nodes().front().q).z(), 0, 1e-12);
}

TEST(Maxwell, MomentRelaxesInClampsThatGiveWay) {
  // The clamps' springs K in series with the section's k0 and its branch k1, all turned at once.
  constexpr double kRelative = 1e-3;  // the ramp is 2 ms of a time constant of 85
  constexpr double kAngle = 0.05, kDt = 1e-4, kBranch = 0.006, kTau = 0.05, ka = 0.2, kb = 0.1;
  constexpr int kRamp = 20;
  CableModel model =
      Specimen({{"maxwell", {{{"tau", kTau}, {"EI1", 0}, {"EI2", 0}, {"GJ", kBranch}, {"EA", 0}}}},
                {"clamp_compliance", {{{"a.torsion", ka}, {"b.torsion", kb}}}}});
  LetRodFollowAtOnce(&model);
  CableSimulation cable(model, {}, Vector3d::Zero());
  ASSERT_TRUE(cable.Settle(Turned({0, 0, 0}, {0, 0, 0})).ok);
  const double K = 1 / (1 / ka + 1 / kb), k0 = kGJ / kLength, k1 = kBranch / kLength;
  const double at_once = 1 / (1 / K + 1 / (k0 + k1)), at_last = 1 / (1 / K + 1 / k0);
  const double tau = kTau * (K + k0 + k1) / (K + k0);
  for (int k = 1; k <= 2000; ++k) {
    const double share = std::min(1.0, static_cast<double>(k) / kRamp);
    ASSERT_TRUE(cable.Step(kDt, Turned({0, 0, 0}, {0, 0, kAngle * share})).ok);
    if (k < 500 || k % 100 != 0) continue;  // it has stopped swinging
    const double since = k * kDt - 0.5 * kRamp * kDt;
    const double moment = kAngle * (at_last + (at_once - at_last) * std::exp(-since / tau));
    EXPECT_NEAR(cable.Report().moment_b.z(), moment, kRelative * moment) << k;
  }
}

TEST(ClampDamping, CarriesAShareOfTheMomentWhileTheClampTurns) {
  // The dashpot holds the clamp where it is when the other one is turned, then the clamp's spring
  // and the rod share the turn: with the time constant d/(k + GJ/L).
  constexpr double kRelative = 1e-3;
  constexpr double kAngle = 0.05, kDt = 1e-4, k = 0.02, d = 0.005;
  constexpr int kRamp = 20;
  CableModel model = Specimen(
      {{"clamp_compliance", {{{"a.torsion", k}}}}, {"clamp_damping", {{{"a.torsion", d}}}}});
  LetRodFollowAtOnce(&model);
  CableSimulation cable(model, {}, Vector3d::Zero());
  ASSERT_TRUE(cable.Settle(Turned({0, 0, 0}, {0, 0, 0})).ok);
  const double k0 = kGJ / kLength, at_last = 1 / (1 / k + 1 / k0), tau = d / (k + k0);
  for (int i = 1; i <= 2000; ++i) {
    const double share = std::min(1.0, static_cast<double>(i) / kRamp);
    ASSERT_TRUE(cable.Step(kDt, Turned({0, 0, 0}, {0, 0, kAngle * share})).ok);
    if (i < 200 || i % 100 != 0) continue;
    const double since = i * kDt - 0.5 * kRamp * kDt;
    const double moment = kAngle * (at_last + (k0 - at_last) * std::exp(-since / tau));
    EXPECT_NEAR(cable.Report().moment_b.z(), moment, kRelative * moment) << i;
  }
}

TEST(Extensions, DampTorsionalModesAsTheWaveEquationSays) {
  // G(lambda) theta'' = rhoJ lambda^2 theta, rigid at b; G theta' = (k + lambda d) theta at a.
  constexpr double kRelative = 3e-4;  // elements: (pi/160)^2/12 of the frequency, and damping's
  constexpr double k = 0.05, d = 1e-5, kBranch = 0.003, kTau = 5e-4;
  CableModel model =
      Specimen({{"maxwell", {{{"tau", kTau}, {"EI1", 0}, {"EI2", 0}, {"GJ", kBranch}, {"EA", 0}}}},
                {"clamp_compliance", {{{"a.torsion", k}}}},
                {"clamp_damping", {{{"a.torsion", d}}}}});
  model.eta_GJ = 1e-6;
  model.elements = 80;
  CableSimulation cable(model, {}, Vector3d::Zero());
  ASSERT_TRUE(cable.Settle(Turned({0, 0, 0}, {0, 0, 0})).ok);
  const auto modes = cable.FindModes(12);
  const auto torsion = std::find_if(modes.begin(), modes.end(), [](const rod::Mode& mode) {
    return mode.kind == rod::ModeKind::kTorsion;
  });
  ASSERT_NE(torsion, modes.end());
  ASSERT_TRUE(torsion->oscillates());
  const auto mismatch = [&](const Complex& lambda) {
    const Complex G = kGJ + lambda * model.eta_GJ + kBranch * lambda * kTau / (1.0 + lambda * kTau);
    const Complex q = lambda * std::sqrt(model.rhoJ() / G);
    return G * q + (k + lambda * d) * std::tanh(q * kLength);
  };
  Complex root = torsion->lambda;
  for (int i = 0; i < 20; ++i) {
    const Complex step = 1e-6 * std::abs(root);
    root -= mismatch(root) * 2.0 * step / (mismatch(root + step) - mismatch(root - step));
  }
  EXPECT_LT(std::abs(mismatch(root)), 1e-9);
  EXPECT_LT(std::abs(torsion->lambda - root), kRelative * std::abs(root));
  // All three laws have their share in the damping.
  EXPECT_GT(torsion->zeta, 0.02);
}

TEST(Extensions, ThatAreNotThereChangeNoBit) {
  // Against a rod that was put together by hand.
  const CableModel m = RoundCableModel(0.4, 0.01, 0.12, 0.035, 0.028, 1e-4);
  rod::RodModel model;
  model.length = m.length;
  model.elements = m.elements;
  model.gravity = kGravity;
  model.section.C_F = {m.GA1, m.GA2, m.EA};
  model.section.C_M = {m.EI1, m.EI2, m.GJ};
  model.section.V_F = {m.eta_GA1, m.eta_GA2, m.eta_EA};
  model.section.V_M = {m.eta_EI1, m.eta_EI2, m.eta_GJ};
  model.section.rhoA = m.mass_per_length;
  model.section.rhoJ = {m.rhoI(), m.rhoI(), m.rhoJ()};
  rod::Rod rod(model);
  CableSimulation cable(m, {}, kGravity);
  Surroundings s;
  s.a.X.q = Quaterniond(0, 1, 0, 0);
  s.b.X.p = {0, 0.2, 0};
  rod.SetConfiguration(rod::BowedShape(s.a.X, s.b.X, m.length, m.elements, kGravity));
  ASSERT_TRUE(rod.Equilibrate().converged);
  ASSERT_TRUE(cable.Settle(s).ok);
  rod.AddRigidMotion(s.a);
  for (int k = 1; k <= 100; ++k) {
    s.b.X.p.z() = 0.01 * std::sin(0.1 * k);
    ASSERT_TRUE(rod.Step(1e-3, s.a.X, s.b.X).converged);
    ASSERT_TRUE(cable.Step(1e-3, s).ok);
  }
  for (int i = 0; i <= m.elements; ++i) {
    EXPECT_EQ(cable.nodes()[i].p, rod.pose(i).p);
    EXPECT_EQ(cable.nodes()[i].q.coeffs(), rod.pose(i).q.coeffs());
  }
}

// ---- A hose in clamps that give way
// --------------------------------------------------------------

constexpr double kSpring = 0.3;  // [N m/rad], about three times EI/L: the ends turn by 0.2 rad

CableModel SoftlyClampedHose() {
  CableModel m = RoundCableModel(0.4, 0.01, 0.12, 0.035, 0.028, 1e-4);
  m.extensions = {{"clamp_compliance",
                   {{{"a.bending", kSpring}, {"a.torsion", kSpring}, {"b.bending", kSpring}}}},
                  {"clamp_damping", {{{"a.bending", 1e-3}, {"b.bending", 1e-3}}}}};
  return m;
}

Surroundings HoseClamps() {
  Surroundings s;
  s.a.X.q = Quaterniond(0, 1, 0, 0);  // a3 down
  s.b.X.p = {0, 0.2, 0};
  return s;
}

/// Forces and moments on the whole cable add up to nothing: weight, clamps, and a flat floor.
void ExpectBalance(CableSimulation* cable) {
  constexpr double kForce = 1e-6, kMoment = 1e-7;  // [N] of 0.47, [N m]
  const CableReport report = cable->Report();
  const std::vector<Pose>& nodes = cable->nodes();
  const double weight = cable->model().length * cable->model().mass_per_length * 9.81;
  Vector3d force = report.force_a + report.force_b;
  Vector3d moment =
      report.moment_a + report.moment_b + (nodes.back().p - nodes.front().p).cross(report.force_b);
  const int elements = cable->model().elements;
  for (int i = 0; i <= elements; ++i) {
    const double share = (i == 0 || i == elements) ? 0.5 : 1.0;
    const Vector3d pull(0, 0, -share * weight / elements);
    force += pull;
    moment += (nodes[i].p - nodes.front().p).cross(pull);
  }
  for (const ContactPoint& point : cable->contacts()) {
    force += point.force_W;
    moment += (point.position_W - nodes.front().p).cross(point.force_W);
  }
  EXPECT_LT(force.norm(), kForce);
  EXPECT_LT(moment.norm(), kMoment);
}

TEST(ClampCompliance, AHoseAtRestTurnsInItsClamps) {
  CableSimulation cable(SoftlyClampedHose(), {}, kGravity);
  const Surroundings clamps = HoseClamps();
  ASSERT_TRUE(cable.Settle(clamps).ok);
  ExpectBalance(&cable);
  EXPECT_LT((cable.nodes().front().p - clamps.a.X.p).norm(), 1e-12);
  const Vector3d psi = RotationLog(clamps.a.X.q.conjugate() * cable.nodes().front().q);
  EXPECT_GT(psi.norm(), 0.05);
  EXPECT_LT((cable.Report().moment_a + kSpring * (clamps.a.X.q * psi)).norm(), 1e-8);
}

TEST(ClampCompliance, AHoseInItsClampsStaysAtRest) {
  constexpr double kDrift = 1e-8;  // [m]
  CableSimulation cable(SoftlyClampedHose(), {}, kGravity);
  ASSERT_TRUE(cable.Settle(HoseClamps()).ok);
  const Vector3d apex = cable.Report().apex;
  for (int k = 0; k < 300; ++k) ASSERT_TRUE(cable.Step(1e-3, HoseClamps()).ok);
  EXPECT_LT((cable.Report().apex - apex).norm(), kDrift);
  ExpectBalance(&cable);
}

TEST(ClampCompliance, AHoseInItsClampsSettlesOnAFloorAndIsLiftedByIt) {
  CableSimulation free(SoftlyClampedHose(), {}, kGravity);
  ASSERT_TRUE(free.Settle(HoseClamps()).ok);
  double bottom = 0;
  for (const Pose& node : free.nodes()) bottom = std::min(bottom, node.p.z());
  const Body floor({{{{0, 0.1, bottom + 0.01 - 0.05}, {1, 0, 0, 0}}, Box{{1, 1, 0.1}}}});
  CableSimulation cable(SoftlyClampedHose(), {&floor}, kGravity);
  Surroundings s = HoseClamps();
  s.obstacles.resize(1);
  const StepOutcome outcome = cable.Settle(s);
  ASSERT_TRUE(outcome.ok) << outcome.message;
  EXPECT_GT(cable.Report().contact_force, 0.01);
  s.obstacles[0].v.z() = 0.2;
  for (int k = 0; k < 200; ++k) {
    s.obstacles[0].X.p.z() += 0.2e-3;
    ASSERT_TRUE(cable.Step(1e-3, s).ok) << k;
    for (const ContactPoint& point : cable.contacts()) ASSERT_LT(point.penetration, 5e-3);
  }
  EXPECT_GT(cable.Report().contact_force, 0.05);
}

TEST(ClampCompliance, StifferAndStifferItBecomesARigidClamp) {
  CableModel model = RoundCableModel(0.4, 0.01, 0.12, 0.035, 0.028, 1e-4);
  const auto apex = [&model] {
    CableSimulation cable(model, {}, kGravity);
    EXPECT_TRUE(cable.Settle(HoseClamps()).ok);
    Surroundings s = HoseClamps();
    for (int k = 1; k <= 100; ++k) {
      s.b.X.p.z() = 0.01 * std::sin(0.05 * k);
      EXPECT_TRUE(cable.Step(1e-3, s).ok) << k;
    }
    return cable.Report().apex;
  };
  const Vector3d rigid = apex();
  const auto error = [&](double k) {
    model.extensions = {
        {"clamp_compliance",
         {{{"a.bending", k}, {"a.torsion", k}, {"b.bending", k}, {"b.torsion", k}}}}};
    return (apex() - rigid).norm();
  };
  // The compliance falls by ten, and so does its effect, down to where Newton's iteration stops.
  const double soft = error(100), stiff = error(1000);
  EXPECT_NEAR(soft / stiff, 10, 0.2);  // large turns: EI/(k L) is 1e-3
  EXPECT_LT(error(1e9), 1e-8);
}

}  // namespace
}  // namespace cosserat_cable
