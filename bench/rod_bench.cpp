// Cost of the rod's time step: cable P2 (200 mm arch between parallel clamps 100 mm apart) whose
// clamps are swept from 10 to 38 Hz in 7 s, in its plane.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "cosserat_cable/rod/initial_shape.h"
#include "cosserat_cable/rod/rod.h"
#include "cosserat_cable/rod/rod_batch.h"

namespace cosserat_cable::rod {
namespace {

using Eigen::Vector3d;

constexpr double kDt = 1e-3;         // s
constexpr int kStepsOfSweep = 7000;  // then from the start again

const Pose kA;
const Pose kB{{0.1, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Vector3d::UnitY()))};

RodModel CableP2(int elements) {
  constexpr double kEI = 0.008, kRhoA = 0.15, kEtaEI = 1e-4, kDiameter = 0.008, kLength = 0.2;
  const double EA = 16 * kEI / (kDiameter * kDiameter), GA = EA / 3, GJ = 0.75 * kEI;
  const double rhoI = kRhoA * kDiameter * kDiameter / 16, eta_GA = 2 * std::sqrt(rhoI * GA);
  RodModel rod;
  rod.length = kLength;
  rod.elements = elements;
  rod.section.C_F = {GA, GA, EA};
  rod.section.C_M = {kEI, kEI, GJ};
  rod.section.V_F = {eta_GA, eta_GA, 4 * kLength / M_PI * std::sqrt(kRhoA * EA)};
  rod.section.V_M = {kEtaEI, kEtaEI, kEtaEI / 2};
  rod.section.rhoA = kRhoA;
  rod.section.rhoJ = {rhoI, rhoI, 2 * rhoI};
  return rod;
}

Rod Settled(const RodModel& model) {
  Rod rod(model);
  rod.SetConfiguration(BowedShape(kA, kB, model.length, model.elements, model.gravity));
  if (!rod.Equilibrate().converged) std::abort();
  return rod;
}

Motion Swept(const Pose& clamp, int step) {
  constexpr double kAmplitude = 1.5e-3;  // m
  const double t = step % kStepsOfSweep * kDt;
  const double phase = 2 * M_PI * (10 * t + 2 * t * t), rate = 2 * M_PI * (10 + 4 * t);
  const Vector3d& axis = Vector3d::UnitX();
  Motion motion = Motion::Resting(clamp);
  motion.X.p += kAmplitude * std::sin(phase) * axis;
  motion.v = kAmplitude * rate * std::cos(phase) * axis;
  motion.a = kAmplitude * (8 * M_PI * std::cos(phase) - rate * rate * std::sin(phase)) * axis;
  return motion;
}

/// Motions of both clamps over the sweep: what they cost is not the rod's.
struct Drive {
  std::vector<Motion> a, b;

  Drive() {
    for (int s = 0; s < kStepsOfSweep; ++s) {
      a.push_back(Swept(kA, s + 1));
      b.push_back(Swept(kB, s + 1));
    }
  }
};

void Report(benchmark::State& state, double cable_steps, double iterations) {
  state.counters["per_cable_step"] =
      benchmark::Counter(cable_steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["iterations"] = iterations / cable_steps;
}

void OneRod(benchmark::State& state) {
  const Drive drive;
  Rod rod = Settled(CableP2(static_cast<int>(state.range(0))));
  double steps = 0, iterations = 0;
  int s = 0;
  for (auto _ : state) {
    const SolveReport report = rod.Step(kDt, drive.a[s], drive.b[s]);
    if (!report.converged) state.SkipWithError("a step did not converge");
    iterations += report.iterations;
    ++steps;
    s = (s + 1) % kStepsOfSweep;
  }
  Report(state, steps, iterations);
}

void RodsInLanes(benchmark::State& state) {
  constexpr int kRods = RodBatch::kMaxRods;
  const Drive drive;
  std::vector<Rod> rods(kRods, Settled(CableP2(static_cast<int>(state.range(0)))));
  std::vector<Rod*> pointers;
  for (Rod& rod : rods) pointers.push_back(&rod);
  RodBatch batch(pointers);
  double steps = 0, iterations = 0;
  int s = 0;
  for (auto _ : state) {
    const std::vector<RodDrive> drives(kRods, {&drive.a[s], &drive.b[s], nullptr});
    for (const SolveReport& report : batch.Step(kDt, drives)) {
      if (!report.converged) state.SkipWithError("a step did not converge");
      iterations += report.iterations;
      ++steps;
    }
    s = (s + 1) % kStepsOfSweep;
  }
  Report(state, steps, iterations);
}

BENCHMARK(OneRod)->Arg(10)->Arg(40)->Arg(160)->Arg(640)->Unit(benchmark::kMicrosecond);
BENCHMARK(RodsInLanes)->Arg(10)->Arg(40)->Arg(160)->Arg(640)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cosserat_cable::rod

BENCHMARK_MAIN();
