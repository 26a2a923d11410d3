// The registry: paths, units, ranges, and what setting a number does to the keys.
#include "cosserat_cable/cable/parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cosserat_cable {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

CableKeys Keys(const std::string& text) {
  Problems problems;
  MapReader map(YamlValue::Root("f", YAML::Load(text), &problems));
  CableKeys keys = ReadCableKeys(&map);
  EXPECT_EQ(problems.ToString(), "");
  return keys;
}

const char* const kCable =
    "{length: 0.2, diameter: 0.008, mass_per_length: 0.09, EI1: 0.012, EI2: 0.006, GJ: 0.009, "
    "eta_EI: 2.0e-4, eta_GJ: null, extensions: {maxwell: [{tau: 0.05, EI: 0.002, GJ: 0.001}, "
    "{tau: 0.5, EI1: 0.003, EI2: 0.006}], clamp_compliance: {a: {bending: 5}}, clamp_damping: {a: "
    "{bending: 1.0e-4}}}}";

TEST(Parameters, HaveUnitSignAndRange) {
  const struct {
    const char *path, *unit;
    ParameterSign sign;
    double lower, upper;
    bool damping;
  } kRows[] = {
      {"length", "m", ParameterSign::kPositive, 0, 20, false},
      {"EI", "N m^2", ParameterSign::kPositive, 0, 1e5, false},
      {"EI2", "N m^2", ParameterSign::kPositive, 0, 1e5, false},
      {"eta_GA1", "N s", ParameterSign::kNonNegative, 0, kInfinity, true},
      {"disc.inertia", "kg m^2", ParameterSign::kPositive, 0, 1e3, false},
      {"extensions.maxwell[0].tau", "s", ParameterSign::kPositive, 0, 1e6, false},
      {"extensions.maxwell[12].EI", "N m^2", ParameterSign::kNonNegative, 0, 1e5, false},
      {"extensions.maxwell[0].EI2", "N m^2", ParameterSign::kNonNegative, 0, 1e5, false},
      {"extensions.clamp_damping.b.torsion", "N m s/rad", ParameterSign::kNonNegative, 0, kInfinity,
       true},
      {"faults.clock.scale", "", ParameterSign::kSigned, -0.5, 1, false},
      {"faults.clock.delay", "s", ParameterSign::kSigned, -1e3, 1e3, false},
      {"faults.sensor[3].tilt[2]", "rad", ParameterSign::kSigned, -3.2, 3.2, false},
      {"faults.sensor[0].low_pass", "s", ParameterSign::kNonNegative, 0, 10, false},
      {"faults.base_motion.b.bracket.damping", "", ParameterSign::kNonNegative, 0, 10, false},
  };
  for (const auto& row : kRows) {
    const std::optional<Parameter> found = FindParameter(row.path);
    ASSERT_TRUE(found) << row.path;
    EXPECT_EQ(found->path, row.path);
    EXPECT_EQ(found->unit, row.unit) << row.path;
    EXPECT_EQ(found->sign, row.sign) << row.path;
    EXPECT_EQ(found->lower, row.lower) << row.path;
    EXPECT_EQ(found->upper, row.upper) << row.path;
    EXPECT_EQ(found->damping, row.damping) << row.path;
  }
  for (const char* none :
       {"", "EJ", "D_E", "extensions", "extensions.sunshine.a", "extensions.maxwell.EI",
        "extensions.maxwell[0]", "extensions.maxwell[-1].EI", "extensions.maxwell[x].EI",
        "extensions.maxwell[0].EJ", "extensions.clamp_damping[0].a.bending", "faults.clock",
        "faults.clock.skale", "faults.sensor.scale", "faults.sensor[0].tilt[3]",
        "faults.base_motion.c.phase", "faults.base_motion.phase"}) {
    EXPECT_FALSE(FindParameter(none)) << none;
    EXPECT_EQ(UnitOf(none), "") << none;
  }
}

TEST(Parameters, AreReadByTheirPaths) {
  const CableKeys keys = Keys(kCable);
  EXPECT_EQ(GetParameter("EI", keys), 0.012);
  EXPECT_EQ(GetParameter("EI2", keys), 0.006);
  EXPECT_EQ(GetParameter("extensions.maxwell[0].EI", keys), 0.002);
  EXPECT_EQ(GetParameter("extensions.maxwell[1].EI2", keys), 0.006);
  EXPECT_EQ(GetParameter("extensions.clamp_compliance.a.bending", keys), 5);
  for (const char* none : {"eta_GJ", "EA", "extensions.maxwell[2].EI", kEndDamping,
                           "faults.clock.scale", "disc.inertia", "nonsense"})
    EXPECT_FALSE(GetParameter(none, keys)) << none;
  EXPECT_TRUE(GivesParameter("eta_GJ", keys));
  EXPECT_TRUE(IsUnknownParameter("eta_GJ", keys));
  EXPECT_FALSE(IsUnknownParameter("eta_EI1", keys));
  EXPECT_FALSE(GivesParameter("EA", keys));
}

TEST(Parameters, OfBothDirectionsKeepTheirRatio) {
  CableKeys keys = Keys(kCable);
  SetParameter("EI", 0.024, &keys);
  EXPECT_EQ(GetParameter("EI2", keys), 0.012);
  SetParameter("EI2", 0.001, &keys);
  EXPECT_EQ(GetParameter("EI1", keys), 0.024);
  SetParameter("extensions.maxwell[1].EI", 0.001, &keys);
  EXPECT_EQ(GetParameter("extensions.maxwell[1].EI2", keys), 0.002);
  SetParameter("eta_GJ", 1e-4, &keys);
  EXPECT_FALSE(IsUnknownParameter("eta_GJ", keys));
}

TEST(Parameters, OfARoundCableStayEqualToTheLastBit) {
  // A cable whose EI1 and EI2 differ by rounding cannot have an anisotropy.
  CableKeys keys = Keys(
      "{length: 0.2, diameter: 0.008, mass_per_length: 0.09, EI: 0.012, GJ: 0.009, eta_EI: 2.0e-4, "
      "eta_GJ: 1.0e-4}");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> factor(0.5, 2);
  for (int i = 0; i < 1000; ++i) {
    const double EI = 0.012 * factor(random), eta = 2e-4 * factor(random);
    SetParameter("EI", EI, &keys);
    SetParameter("eta_EI", eta, &keys);
    ASSERT_EQ(GetParameter("EI1", keys), EI);
    ASSERT_EQ(GetParameter("EI2", keys), EI);
    ASSERT_EQ(GetParameter("eta_EI2", keys), eta);
  }
}

TEST(Parameters, ThatAreSetMakeTheirEntry) {
  CableKeys keys = Keys("{length: 0.2, mass_per_length: 0.09, EI: 0.012}");
  SetParameter(kEndDamping, 3e-4, &keys);
  EXPECT_EQ(GetParameter(kEndDamping, keys), 3e-4);
  EXPECT_TRUE(GivesParameter(kEndDamping, keys));
  EXPECT_FALSE(GivesParameter("extensions.clamp_damping.a.torsion", keys));
  // A branch needs a relaxation time: of the size of the cable's own period until it is set.
  SetParameter("extensions.maxwell[0].EI", 0.002, &keys);
  const double tau = *GetParameter("extensions.maxwell[0].tau", keys);
  EXPECT_GT(tau, 1e-3);
  EXPECT_LT(tau, 1);
  EXPECT_EQ(GetParameter("extensions.maxwell[0].EI2", keys), 0.002);
  EXPECT_EQ(GetParameter("extensions.maxwell[0].GJ", keys), 0);
  SetParameter("extensions.maxwell[1].GJ", 0.001, &keys);
  EXPECT_EQ(GetParameter("extensions.maxwell[1].GJ", keys), 0.001);
  SetParameter("faults.clock.scale", 1e-3, &keys);
  EXPECT_EQ(keys.faults.value->clock->scale, 1e-3);
  EXPECT_EQ(keys.faults.value->clock->delay, 0);
  EXPECT_TRUE(keys.faults.given());
  SetParameter("faults.sensor[0].tilt[1]", 0.1, &keys);
  EXPECT_EQ(keys.faults.value->sensor.at(0).tilt, Eigen::Vector3d(0, 0.1, 0));
  EXPECT_EQ(keys.faults.value->sensor.at(0).scale, 1);
  SetParameter("faults.base_motion.a.bracket.frequency", 30, &keys);
  EXPECT_TRUE(keys.faults.value->a->has_bracket());
  EXPECT_FALSE(keys.faults.value->b);
  const std::string before = WriteCableKeys(keys, "");
  for (const char* none : {"extensions.maxwell[3].EI", "extensions.sunshine.a", "faults.clock.x",
                           "faults.sensor[2].scale", "EJ", "disc.inertia"})
    EXPECT_THROW(SetParameter(none, 1, &keys), std::invalid_argument) << none;
  EXPECT_EQ(WriteCableKeys(keys, ""), before);
}

TEST(Parameters, HaveANeutralValueWhereTheyDoNothing) {
  const auto neutral = [](const char* path) { return FindParameter(path)->neutral; };
  EXPECT_EQ(neutral("faults.clock.scale"), 0);
  EXPECT_EQ(neutral("faults.sensor[0].scale"), 1);
  EXPECT_EQ(neutral("faults.sensor[0].low_pass"), 0);
  EXPECT_EQ(neutral("faults.base_motion.a.bracket.frequency"), kInfinity);
  EXPECT_EQ(neutral("faults.base_motion.a.amplitude"), 1);
  EXPECT_FALSE(neutral("faults.base_motion.a.bracket.damping"));
  EXPECT_EQ(neutral("extensions.maxwell[0].EI"), 0);
  EXPECT_FALSE(neutral("extensions.maxwell[0].tau"));
  EXPECT_EQ(neutral(kEndDamping), 0);
  EXPECT_FALSE(neutral("EI"));
}

TEST(Parameters, HaveASizeThatGrowsWithTheCable) {
  // Twice the length, with all else equal: a quarter of the frequency.
  const CableKeys near = Keys("{length: 0.2, mass_per_length: 0.09, EI: 0.012}");
  const CableKeys far = Keys("{length: 0.4, mass_per_length: 0.09, EI: 0.012}");
  const auto ratio = [&](const char* path) {
    return TypicalSize(path, far) / TypicalSize(path, near);
  };
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(ratio("extensions.maxwell[0].tau"), 4, kRounding);
  EXPECT_NEAR(ratio("eta_EI"), 4, kRounding);
  EXPECT_NEAR(ratio(kEndDamping), 2, kRounding);
  EXPECT_NEAR(ratio("extensions.clamp_compliance.a.bending"), 0.5, kRounding);
  EXPECT_NEAR(ratio("EI"), 1, kRounding);
  // w = (1.875/L)^2 sqrt(EI/rhoA) = 32.09/s; 2 0.05 EI/w.
  EXPECT_NEAR(TypicalSize("eta_EI", near), 0.1 * 0.012 / 32.09, 1e-3 * 3.74e-5);
}

}  // namespace
}  // namespace cosserat_cable
