// Every cause says where a diagnosis begins to look for it, in the terms of the registry.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cosserat_cable/cable/parameters.h"
#include "cosserat_cable/causes/cause.h"

namespace cosserat_cable {
namespace {

// The names that verdicts may use, in the order of the alphabet (measurement sets, version 1).
const char* const kNames[] = {"added_mass",
                              "air_drag",
                              "anisotropy",
                              "base_motion",
                              "bend_twist_coupling",
                              "clamp_compliance",
                              "clamp_damping",
                              "clamp_friction",
                              "clamp_play",
                              "clock",
                              "contact",
                              "drift",
                              "external_damping",
                              "maxwell",
                              "nonlinear_stiffness",
                              "rest_curvature",
                              "section_friction",
                              "sensor",
                              "structural_damping"};

TEST(CausesTest, AreTheNineteenOfTheFormat) {
  std::vector<std::string> names;
  for (const Cause& cause : Causes()) names.push_back(cause.name);
  EXPECT_EQ(names, std::vector<std::string>(std::begin(kNames), std::end(kNames)));
  for (const char* name : kNames) ASSERT_NE(FindCause(name), nullptr) << name;
  EXPECT_EQ(FindCause("sunshine"), nullptr);
}

TEST(CausesTest, HaveWordsAndKnowWhatTheyContain) {
  for (const Cause& cause : Causes()) {
    EXPECT_FALSE(cause.words.empty()) << cause.name;
    if (cause.law) {
      EXPECT_EQ(cause.law->name, cause.name);
    }
    for (const std::string& simpler : cause.contains)
      EXPECT_NE(FindCause(simpler), nullptr) << cause.name << " contains " << simpler;
    EXPECT_TRUE(cause.from_simpler.empty() || !cause.contains.empty()) << cause.name;
  }
}

// A hypothesis may set another cause's numbers too (a dashpot needs the spring beside it), but it
// has one of its own, and each number is a parameter that a fit can free.
TEST(CausesTest, HypothesesNameParameters) {
  for (const Cause& cause : Causes()) {
    std::vector<Hypothesis> all = cause.hypotheses;
    all.insert(all.end(), cause.from_simpler.begin(), cause.from_simpler.end());
    // Obstacles are tried in the way of the motion, which no list knows beforehand.
    EXPECT_EQ(all.empty(), cause.name == "contact") << cause.name;
    for (const Hypothesis& hypothesis : all) {
      bool own = false;
      ASSERT_FALSE(hypothesis.components.empty()) << cause.name;
      for (const auto& component : hypothesis.components) {
        ASSERT_FALSE(component.empty()) << cause.name;
        for (const HypothesisNumber& number : component) {
          EXPECT_TRUE(FindParameter(number.path)) << number.path;
          EXPECT_GT(number.times, -1e-12) << number.path;
          own = own || number.path.find("." + cause.name) != std::string::npos;
        }
      }
      EXPECT_TRUE(own) << cause.name;
    }
  }
}

}  // namespace
}  // namespace cosserat_cable
