// A cable whose state was written and read goes on as the one that it was written of, to the last
// bit.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "cable/cable_cases.h"
#include "cosserat_cable/cable/cable_fleet.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

constexpr double kDt = 1e-3;
const Vector3d kGravity(0, 0, -9.81);

/// A hose that swings over a floor, and on it.
CableModel Hose() {
  CableModel model = RoundCableModel(0.4, 0.01, 0.12, 0.05, 0.04, 1e-4);
  model.elements = 12;
  return model;
}

Surroundings At(int step) {
  const double w = 80, t = step * kDt, amplitude = 0.01;
  Surroundings s;
  s.a.X.q = Eigen::Quaterniond(0, 1, 0, 0);
  s.b.X.p = {0, 0.2, amplitude * std::sin(w * t)};
  s.b.v.z() = amplitude * w * std::cos(w * t);
  s.b.a.z() = -amplitude * w * w * std::sin(w * t);
  s.obstacles.resize(1);
  return s;
}

const Body& Floor() {
  static const Body floor({Shape{{{0, 0.1, -0.24}, {1, 0, 0, 0}}, Box{{1, 1, 0.1}}}});
  return floor;
}

CableSimulation Simulate(const CableModel& model) {
  return CableSimulation(model, {&Floor()}, kGravity);
}

void Advance(CableSimulation* cable, int from, int to) {
  CableFleet fleet({cable});
  for (int step = from; step <= to; ++step) {
    const Surroundings then = At(step);
    ASSERT_TRUE(fleet.Step(kDt, {&then})[0].ok);
  }
}

void ExpectGoesOnAlike(const CableModel& model) {
  constexpr int kWritten = 60, kEnd = 90;
  CableSimulation first = Simulate(model), second = Simulate(model);
  ASSERT_TRUE(first.Settle(At(0)).ok);
  Advance(&first, 1, kWritten);
  const std::vector<double> state = first.State();
  second.SetState(state);
  EXPECT_TRUE(second.State() == state);
  Advance(&first, kWritten + 1, kEnd);
  Advance(&second, kWritten + 1, kEnd);
  // Not the lists themselves: their hundreds of numbers would be the message.
  EXPECT_TRUE(first.State() == second.State());
  EXPECT_EQ(first.Report().energy.Residual(), second.Report().energy.Residual());
}

TEST(CableStateTest, OfAPlainCable) { ExpectGoesOnAlike(Hose()); }

TEST(CableStateTest, OfOneWithMemoryInSectionAndClamps) {
  CableModel model = Hose();
  model.extensions.push_back(
      {"maxwell", {{{"tau", 0.02}, {"EI1", 0.02}, {"EI2", 0.02}, {"GJ", 0.01}, {"EA", 0.0}}}});
  model.extensions.push_back(
      {"clamp_friction", {{{"a.stuck", 1.0}, {"a.slip_moment", 1e-3}, {"a.spring", 1.0}}}});
  ExpectGoesOnAlike(model);
}

TEST(CableStateTest, OfATautOne) {
  CableModel model = Hose();
  model.length = 0.199;
  ExpectGoesOnAlike(model);
}

TEST(CableStateTest, StepsInPartsGoOnAlike) {
  CableSimulation first = Simulate(Hose()), second = Simulate(Hose());
  ASSERT_TRUE(first.Settle(At(0)).ok);
  Advance(&first, 1, 20);
  second.SetState(first.State());
  Surroundings far = At(21);
  far.b.X.p.x() = 0.1;
  CableFleet one({&first}), other({&second});
  const StepOutcome a = one.Step(kDt, {&far})[0], b = other.Step(kDt, {&far})[0];
  EXPECT_GT(a.substeps + (a.ok ? 0 : 2), 1);
  EXPECT_EQ(a.ok, b.ok);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.message, b.message);
  EXPECT_TRUE(first.State() == second.State());
}

TEST(CableStateTest, IsRefusedByAnotherModel) {
  CableModel longer = Hose();
  longer.elements = 13;
  CableSimulation first = Simulate(Hose()), second = Simulate(longer);
  ASSERT_TRUE(first.Settle(At(0)).ok);
  const std::vector<double> state = first.State();
  EXPECT_THROW(second.SetState(state), std::invalid_argument);
  EXPECT_THROW(first.SetState({state.begin(), state.end() - 1}), std::invalid_argument);
  EXPECT_THROW(first.SetState({}), std::invalid_argument);
}

}  // namespace
}  // namespace cosserat_cable
