// Cost of the rod's time step: of one rod, of rods side by side in lanes, and of many.
#include <benchmark/benchmark.h>

#include "fma_peak.h"
#include "swept_cables.h"

namespace cosserat_cable::bench {
namespace {

constexpr int kShippedElements = 40;

void Report(benchmark::State& state, int cables, int elements, double iterations) {
  using benchmark::Counter;
  const double cable_steps = static_cast<double>(state.iterations()) * cables;
  state.counters["cable_step"] = Counter(cable_steps, Counter::kIsRate | Counter::kInvert);  // s
  state.counters["node_step"] =
      Counter(cable_steps * (elements + 1), Counter::kIsRate | Counter::kInvert);  // s
  state.counters["iterations"] = iterations / cable_steps;
  state.counters["cables"] = cables;
  state.counters["elements"] = elements;
}

void OneRod(benchmark::State& state) {
  const int elements = static_cast<int>(state.range(0));
  rod::Rod rod = Settled(CableP2(elements));
  Drive drive;
  double iterations = 0;
  for (auto _ : state) {
    const rod::SolveReport report = rod.Step(kDt, drive.a(), drive.b());
    if (!report.converged) state.SkipWithError("a step did not converge");
    iterations += report.iterations;
    drive.Advance();
  }
  Report(state, 1, elements, iterations);
}

void StepFleet(benchmark::State& state, int cables, int elements) {
  Fleet fleet(cables, elements);
  Drive drive;
  double iterations = 0;
  for (auto _ : state) {
    iterations += fleet.Step(drive);
    drive.Advance();
  }
  Report(state, cables, elements, iterations);
}

void RodsInLanes(benchmark::State& state) {
  StepFleet(state, rod::RodBatch::PreferredRods(), static_cast<int>(state.range(0)));
}

void ManyRods(benchmark::State& state) {
  StepFleet(state, static_cast<int>(state.range(0)), kShippedElements);
}

/// The most floating-point operations a second that one core does.
void FmaPeak(benchmark::State& state) {
  double operations = 0;
  for (auto _ : state) operations += RunFma();
  state.counters["flops"] = benchmark::Counter(operations, benchmark::Counter::kIsRate);  // 1/s
}

void Elements(benchmark::internal::Benchmark* benchmark) {
  for (int elements = 10; elements <= 640; elements *= 2) benchmark->Arg(elements);
}

BENCHMARK(OneRod)->Apply(Elements)->Unit(benchmark::kMicrosecond);
BENCHMARK(RodsInLanes)->Apply(Elements)->Unit(benchmark::kMicrosecond);
BENCHMARK(ManyRods)->Arg(1)->Arg(4)->Arg(8)->Arg(64)->Arg(256)->Arg(1024)->Unit(
    benchmark::kMicrosecond);
BENCHMARK(FmaPeak)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cosserat_cable::bench

BENCHMARK_MAIN();
