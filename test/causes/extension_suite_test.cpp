// What holds for every extension of a cable: it reads back what it writes, changes no bit where its
// amplitude is zero, keeps the energy's account, leaves its neighbours in a batch alone, and goes
// on from a state that was written.
#include <gtest/gtest.h>

#include <set>

#include "cable/cable_text.h"
#include "cosserat_cable/cable/cable_rod.h"
#include "cosserat_cable/math/small_eigen.h"
#include "cosserat_cable/rod/initial_shape.h"
#include "cosserat_cable/rod/point_loads.h"
#include "cosserat_cable/rod/rod_batch.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

const Vector3d kGravity(0, 0, -9.81);
constexpr double kDt = 1e-3;

struct Example {
  std::string name, entry;
  std::string nothing;  ///< with its amplitude at zero; empty: it has none that can be
};

void PrintTo(const Example& example, std::ostream* out) { *out << example.name; }

const std::vector<Example>& Examples() {
  static const std::vector<Example> examples = {
      {"added_mass", "{s: 0.12, mass: 0.003}", "{s: 0.12, mass: 0}"},
      {"air_drag", "{Cd: 300}", "{Cd: 0}"},
      {"anisotropy", "{difference: -0.3, roll: 0.4}", "{difference: 0, roll: 0.4}"},
      {"bend_twist_coupling", "{c1: -0.4, c2: 0.3}", "{c1: 0, c2: 0}"},
      {"clamp_compliance", "{a: {bending: 0.5, torsion: 2}, b: {bending: 0.6}}", ""},
      {"clamp_damping", "{b: {torsion: 1.0e-6}}", ""},
      {"clamp_friction", "{a: {stuck: 0.5, slip_moment: 0.002, spring: 0.3}}",
       "{a: {stuck: 0, slip_moment: 0.002, spring: 0}}"},
      {"clamp_friction", "{a_torsion: {stuck: 2, slip_moment: 0.001, spring: 3}}",
       "{a_torsion: {stuck: 0, slip_moment: 0.001, spring: 0}}"},
      {"clamp_play", "{b: {gap: 0.01, stiffness: 0.5}}", "{b: {gap: 0, stiffness: 0.5}}"},
      {"contact", "{plane: {azimuth: 0, elevation: 0, offset: -0.003}, stiffness: 300}",
       "{plane: {azimuth: 0, elevation: 0, offset: -0.003}, stiffness: 0}"},
      {"external_damping", "{rate: 20}", "{rate: 0}"},
      {"maxwell", "[{tau: 0.02, EI: 0.003, GJ: 0.001}]", ""},
      {"nonlinear_stiffness", "{change: -0.5, curvature: 5}", "{change: 0, curvature: 5}"},
      {"rest_curvature", "{k1: 3, k2: -2, twist: 1}", "{k1: 0, k2: 0, twist: 0}"},
      {"section_friction", "{EI: 0.004, slip_curvature: 1.5, spread: 1}",
       "{EI: 0, slip_curvature: 1.5}"},
      {"structural_damping", "{loss_factor: 0.1}", "{loss_factor: 0}"},
  };
  return examples;
}

std::string Text(const std::string& name, const std::string& entry) {
  return std::string(kSpecimen) + "  elements: 12\n  extensions:\n    " + name + ": " + entry +
         "\n";
}

CableModel Plain() { return LoadOne(std::string(kSpecimen) + "  elements: 12\n"); }

const Pose kA{{0, 0, 0}, Eigen::Quaterniond(0, 1, 0, 0)};
const Pose kB{{0.02, 0.1, 0}, {1, 0, 0, 0}};

rod::Rod Settled(const rod::RodModel& model) {
  rod::Rod rod(model);
  rod.SetConfiguration(rod::BowedShape(kA, kB, model.length, model.elements, model.gravity));
  EXPECT_TRUE(rod.Equilibrate().converged);
  return rod;
}

Pose Shaken(int step) {
  Pose b = kB;
  const double f = std::pow(1 - std::cos(0.1 * step), 2);
  b.p += f * Vector3d(0.004, 0.003, -0.005);
  return b;
}

void ExpectSameBits(const rod::Rod& one, const rod::Rod& two) {
  for (int i = 0; i <= one.elements(); ++i) {
    ASSERT_EQ(one.pose(i).p, two.pose(i).p) << i;
    ASSERT_EQ(one.pose(i).q.coeffs(), two.pose(i).q.coeffs()) << i;
    ASSERT_EQ(ToEigen(one.velocity(i)), ToEigen(two.velocity(i))) << i;
  }
  EXPECT_EQ(one.energy_balance().dissipated, two.energy_balance().dissipated);
  EXPECT_EQ(one.reaction_a().moment, two.reaction_a().moment);
}

class ExtensionSuite : public testing::TestWithParam<Example> {
 protected:
  rod::RodModel Model() const {
    return MakeRodModel(LoadOne(Text(GetParam().name, GetParam().entry)), kGravity);
  }
};

TEST(ExtensionSuiteTest, HasAnExampleOfEach) {
  const std::string said = SaidWith("  extensions: {sunshine: 1}\n");
  std::set<std::string> known, tried;
  std::istringstream names(said.substr(said.find("one of ") + 7));
  for (std::string name; names >> name;)
    known.insert(name.back() == ',' ? name.substr(0, name.size() - 1) : name);
  for (const Example& example : Examples()) tried.insert(example.name);
  tried.insert("drift");  // only a record has it
  EXPECT_EQ(known, tried);
}

TEST_P(ExtensionSuite, ReadsBackWhatItWrites) {
  const Loaded loaded =
      Load(Replaced(Text(GetParam().name, GetParam().entry), "0.012", "0.0123456789012345678"));
  ASSERT_EQ(loaded.said, "");
  const std::string text = WriteCableFile(loaded.file);
  const Loaded back = Load(text);
  EXPECT_EQ(back.said, "") << text;
  ASSERT_EQ(back.file.cables[0].extensions.size(), 1u);
  EXPECT_EQ(back.file.cables[0].extensions[0].name, GetParam().name);
  EXPECT_EQ(back.file.cables[0].extensions[0].parts, loaded.file.cables[0].extensions[0].parts);
  EXPECT_EQ(WriteCableFile(back.file), text);
}

TEST_P(ExtensionSuite, WithNoAmplitudeChangesNoBit) {
  if (GetParam().nothing.empty()) return;
  rod::Rod plain = Settled(MakeRodModel(Plain(), kGravity));
  rod::Rod other =
      Settled(MakeRodModel(LoadOne(Text(GetParam().name, GetParam().nothing)), kGravity));
  for (int step = 1; step <= 50; ++step) {
    ASSERT_TRUE(plain.Step(kDt, kA, Shaken(step)).converged);
    ASSERT_TRUE(other.Step(kDt, kA, Shaken(step)).converged);
  }
  ExpectSameBits(plain, other);
}

TEST_P(ExtensionSuite, ChangesWhatTheCableDoes) {
  if (GetParam().name == "clamp_damping") return;  // at a disc, which a measurement set knows of
  rod::Rod plain = Settled(MakeRodModel(Plain(), kGravity)), other = Settled(Model());
  for (int step = 1; step <= 50; ++step) {
    ASSERT_TRUE(plain.Step(kDt, kA, Shaken(step)).converged);
    ASSERT_TRUE(other.Step(kDt, kA, Shaken(step)).converged);
  }
  EXPECT_GT((plain.pose(6).p - other.pose(6).p).norm(), 1e-5);
}

TEST_P(ExtensionSuite, KeepsTheEnergysAccountInAFreeDecay) {
  constexpr double kRelative = 3e-3;  // second order in the step, and friction's kinks
  rod::RodModel model = Model();
  model.b = rod::EndModel::Free();
  rod::Rod rod(model);
  rod.SetConfiguration(rod::StraightShape(kA, model.length, model.elements));
  const rod::PointLoads pull(model.length, {{model.length, {0.15, 0.1, 0}}});
  ASSERT_TRUE(rod.Equilibrate(&pull).converged);
  const double stored = rod.elastic_energy();
  double largest = 0;
  for (int step = 0; step < 1500; ++step) {
    ASSERT_TRUE(rod.Step(2e-4, kA, kA).converged) << step;
    largest = std::max(largest, std::abs(rod.energy_balance().Residual()));
  }
  EXPECT_LT(largest, kRelative * stored);
  EXPECT_GT(rod.energy_balance().dissipated, 0.05 * stored);
}

TEST_P(ExtensionSuite, LeavesItsNeighboursAlone) {
  const rod::RodModel with = Model(), plain = MakeRodModel(Plain(), kGravity);
  if (!with.a.clamped() || !with.b.clamped()) return;  // they do not go together
  const auto run = [&](const rod::RodModel& beside) {
    std::vector<rod::Rod> rods;
    rods.push_back(Settled(beside));
    for (int k = 0; k < 4; ++k) rods.push_back(Settled(plain));
    std::vector<rod::Rod*> pointers;
    for (rod::Rod& rod : rods) pointers.push_back(&rod);
    rod::RodBatch batch(pointers);
    for (int step = 1; step <= 50; ++step) {
      const Pose b = Shaken(step);
      batch.Step(kDt, std::vector<rod::RodDrive>(rods.size(), {&kA, &b, nullptr}));
    }
    return rod::Rod(rods[2]);
  };
  ExpectSameBits(run(with), run(plain));
}

// The internal variables of its laws are in it.
TEST_P(ExtensionSuite, GoesOnFromItsState) {
  constexpr int kWritten = 40, kEnd = 80;
  rod::Rod first = Settled(Model()), second(Model());
  for (int step = 1; step <= kWritten; ++step)
    ASSERT_TRUE(first.Step(kDt, kA, Shaken(step)).converged);
  second.SetState(first.State());
  for (int step = kWritten + 1; step <= kEnd; ++step) {
    ASSERT_TRUE(first.Step(kDt, kA, Shaken(step)).converged);
    ASSERT_TRUE(second.Step(kDt, kA, Shaken(step)).converged);
  }
  ExpectSameBits(first, second);
}

TEST_P(ExtensionSuite, HasTangentsThatAreItsStressesDerivatives) {
  constexpr double kStep = 1e-6, kRelative = 1e-7;  // central differences
  for (const auto& prototype : Model().laws) {
    const auto law = prototype->Clone();
    law->Reset(1);
    law->BeginStep(kDt);
    for (const Vector3d& kappa : {Vector3d(0.3, -0.1, 0.2), Vector3d(4, 3, -2)}) {
      const auto stress = [&](const Vector3d& at) {
        rod::SectionResponse response;
        law->Evaluate(0, {Vector3d::Zero(), Vector3d::Zero(), at, Vector3d::Zero()}, 0, &response);
        return response;
      };
      const Eigen::Matrix3d tangent = stress(kappa).tangent.bottomRightCorner<3, 3>();
      EXPECT_EQ(tangent, tangent.transpose());
      for (int k = 0; k < 3; ++k) {
        const Vector3d step = kStep * Vector3d::Unit(k);
        const Vector3d slope =
            (stress(kappa + step).stress - stress(kappa - step).stress).tail<3>() / (2 * kStep);
        EXPECT_LT((slope - tangent.col(k)).norm(), kRelative * tangent.norm());
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExtensionSuite, testing::ValuesIn(Examples()), [](const auto& info) {
  return info.param.name + "_" + std::to_string(info.index);
});

}  // namespace
}  // namespace cosserat_cable
