// The same bits, run after run and build after build: what four cables come to is pinned per vector
// unit. Who changes what is computed pins it anew; who did not mean to has found a mistake.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

#include "cable/cable_cases.h"
#include "cosserat_cable/cable/cable_fleet.h"
#include "cosserat_cable/math/kernel.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

constexpr double kDt = 1e-3;
constexpr int kSteps = 150;

/// FNV-1a of all numbers' bits.
class Hash {
 public:
  void Add(const std::vector<double>& numbers) {
    for (const double number : numbers) {
      unsigned char bytes[sizeof number];
      std::memcpy(bytes, &number, sizeof number);
      for (const unsigned char byte : bytes) hash_ = (hash_ ^ byte) * 0x100000001b3u;
    }
  }
  std::string InHexadecimal() const {
    char text[20];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_));
    return text;
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

const Body& Floor() {
  static const Body floor({Shape{{{0, 0.1, -0.24}, {1, 0, 0, 0}}, Box{{1, 1, 0.1}}}});
  return floor;
}

CableModel Hose(double length, int elements) {
  CableModel model = RoundCableModel(length, 0.01, 0.12, 0.05, 0.04, 1e-4);
  model.elements = elements;
  return model;
}

/// End b goes to and fro along parabolas: no function of the C library has a part in it.
Surroundings At(int step) {
  constexpr int kHalf = 20;  // steps of half a period
  const double x = 2.0 * (step % kHalf) / kHalf - 1, sign = step / kHalf % 2 == 0 ? 1 : -1;
  const double amplitude = 0.008, rate = 2 / (kHalf * kDt);
  Surroundings s;
  s.a.X.q = Eigen::Quaterniond(0, 1, 0, 0);
  s.b.X.p = {0, 0.2, sign * amplitude * (1 - x * x)};
  s.b.v.z() = -2 * sign * amplitude * rate * x;
  s.b.a.z() = -2 * sign * amplitude * rate * rate;
  s.obstacles.resize(1);
  return s;
}

/// Side by side, on a floor and off it, taut, with memory, and one by itself.
std::string Simulate(int threads) {
  std::vector<CableModel> models = {Hose(0.4, 12), Hose(0.3, 12), Hose(0.198, 12), Hose(0.35, 12),
                                    Hose(0.33, 25)};
  models[3].extensions.push_back(
      {"maxwell", {{{"tau", 0.02}, {"EI1", 0.02}, {"EI2", 0.02}, {"GJ", 0.01}, {"EA", 0.0}}}});
  std::vector<CableSimulation> cables;
  for (const CableModel& model : models)
    cables.emplace_back(model, std::vector<const Body*>{&Floor()}, Vector3d(0, 0, -9.81));
  std::vector<CableSimulation*> pointers;
  for (CableSimulation& cable : cables) {
    EXPECT_TRUE(cable.Settle(At(0)).ok);
    pointers.push_back(&cable);
  }
  CableFleet fleet(pointers, threads, LoneCable::kByItself);
  for (int step = 1; step <= kSteps; ++step) {
    const Surroundings then = At(step);
    for (const StepOutcome& outcome :
         fleet.Step(kDt, std::vector<const Surroundings*>(cables.size(), &then)))
      EXPECT_TRUE(outcome.ok) << outcome.message;
  }
  Hash hash;
  for (CableSimulation& cable : cables) {
    hash.Add(cable.State());
    const CableReport report = cable.Report();
    hash.Add({report.clearance, report.contact_force, report.energy.Residual()});
  }
  return hash.InHexadecimal();
}

TEST(ResultHashTest, IsThatOfTheVectorUnit) {
  // Of the release build by GCC 12, with glibc 2.36. A processor with AVX-512 has run all three,
  // the lower ones in builds with COSSERAT_CABLE_VECTOR_UNIT; those with AVX2 and above come to the
  // same.
  const std::map<std::string, std::string> pinned = {{"x86-64-v4", "a83d80af75cd4366"},
                                                     {"x86-64-v3", "a83d80af75cd4366"},
                                                     {"x86-64", "806f81f305c80e00"}};
  if (std::string(COSSERAT_CABLE_BUILD_TYPE) != "Release" || __GNUC__ != 12)
    GTEST_SKIP() << "pinned for the release build by GCC 12";
  const auto expected = pinned.find(VectorUnit());
  if (expected == pinned.end()) GTEST_SKIP() << "nothing is pinned for this machine";
  EXPECT_EQ(Simulate(1), expected->second) << VectorUnit();
}

TEST(ResultHashTest, DependsNeitherOnTheRunNorOnGroups) {
  const std::string first = Simulate(1);
  EXPECT_EQ(Simulate(1), first);
  EXPECT_EQ(Simulate(2), first);
}

}  // namespace
}  // namespace cosserat_cable
