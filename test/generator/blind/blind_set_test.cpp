// Blind sets: what is asked for is in them, and the truth is not.

#include "blind_set.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "../effect_sets.h"
#include "rig_mix.h"
#include "strength.h"

namespace cosserat_cable::generator {
namespace {

BlindSet setOf(const std::string& suite, std::uint64_t seed, const std::string& effect = "") {
  BlindPlan plan;
  plan.suite = suite;
  plan.seed = seed;
  plan.effect = effect;
  return blindSet(plan);
}

std::string textOf(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(BlindSet, AnEffectIsAsStrongAsItIsAskedFor) {
  const BlindSet set = setOf("single", 3, "anisotropy");
  EXPECT_EQ(set.label, "anisotropy");
  EXPECT_NEAR(set.reached, 5.0, 1.3);
  EXPECT_EQ(set.expected.verdict, "named");
  EXPECT_EQ(set.expected.causes, std::vector<std::string>{"anisotropy"});
  EXPECT_GE(set.seen.experiments.size(), 4u);
  EXPECT_EQ(set.strengths.size(), set.seen.experiments.size());
}

TEST(BlindSet, TheSameSeedIsTheSameSet) {
  const BlindSet one = setOf("null", 5), same = setOf("null", 5), other = setOf("null", 6);
  EXPECT_EQ(one.seen.experiments[0].values, same.seen.experiments[0].values);
  EXPECT_NE(one.seen.truth.EI, other.seen.truth.EI);
  EXPECT_EQ(one.expected.verdict, "none");
  EXPECT_TRUE(one.seen.effects.empty());
}

TEST(BlindSet, NominalStiffnessIsWrongByLessThanAThird) {
  for (std::uint64_t seed = 1; seed < 4; ++seed) {
    const BlindSet set = setOf("unidentifiable", 3 * seed);
    const double ratio = set.seen.EI_guess / set.seen.truth.EI;
    EXPECT_NE(ratio, 1.0);
    EXPECT_LE(ratio, 1.3);
    EXPECT_GE(ratio, 1.0 / 1.3);
    EXPECT_FALSE(set.expected.undetermined.empty());
  }
}

TEST(BlindSet, NothingOfTheTruthIsInTheSetsFolder) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "blind_set_test";
  writeBlind(setOf("outside", 1, "stribeck_support"), folder.string());
  EXPECT_NE(textOf(folder / "truth.json").find("stribeck_support"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "unseen" / "unseen.csv"));
  for (const char* part : {"set", "unseen"}) {
    for (const auto& file : std::filesystem::directory_iterator(folder / part)) {
      const std::string text = textOf(file.path());
      EXPECT_EQ(text.find("stribeck"), std::string::npos) << file.path();
      EXPECT_EQ(file.path().filename().string().find("truth"), std::string::npos);
    }
  }
  std::filesystem::remove_all(folder);
}

TEST(BlindSet, UnknownNamesAreRefused) {
  EXPECT_THROW(setOf("nosuch", 1), std::invalid_argument);
  EXPECT_THROW(setOf("single", 1, "nosuch"), std::invalid_argument);
  EXPECT_THROW(setOf("outside", 1, "air_drag"), std::invalid_argument);
}

TEST(Recalibration, TakesWhatItCanOfADampingAndLeavesTheRest) {
  Random random(4);
  const RigMix mix = mixRigs({Rig::kSmall, Rig::kShort}, false, &random);
  const Recalibration recalibration(mix.seen, 40.0);
  const auto nothing = recalibration.fit(mix.seen, Eigen::Vector4d::Zero());
  EXPECT_LT(nothing.strength, 1e-6);
  const EffectScale scale = effectScale(mix.seen, mix.cable);
  const Variation drag = varied(effectKind("external_damping"), scale, "", &random);
  const Strength strength = sizeFor(drag, 2.0, 40.0, mix.seen, scale);
  EXPECT_NEAR(strength.left.strength, 2.0, 0.6);
  // Most of a damping is eta_EI to the plain rod.
  EXPECT_GT(strength.left.change[1], 0.05);
}

TEST(Noise, CorrelationAndMarginalSpread) {
  Random random(1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(200000);
  addNoise(2.0, 0.6, &random, x);
  const double variance = x.squaredNorm() / static_cast<double>(x.size());
  const Eigen::Index n = x.size() - 1;
  EXPECT_NEAR(variance, 4.0, 0.1);
  EXPECT_NEAR(x.head(n).dot(x.tail(n)) / x.squaredNorm(), 0.6, 0.01);
}

}  // namespace
}  // namespace cosserat_cable::generator
