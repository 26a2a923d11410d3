// Puts the solver under stress with random cables; docs/reliability.md says with which, and has the
// figures. Fails where a promise made there is broken.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "cosserat_cable/console/exit_code.h"
#include "cosserat_cable/console/interrupt.h"
#include "cosserat_cable/console/progress.h"
#include "cosserat_cable/console/run_tool.h"
#include "parse_arguments.h"
#include "stress/stress_run.h"

namespace cosserat_cable::stress {
namespace {

// Of the cables whose elements are short enough.
constexpr double kMostFailures = 1e-3;
constexpr int kMostListed = 20;

struct Counts {
  int runs = 0, converged = 0, named = 0, unnamed = 0, not_finite = 0, past_bound = 0;
  int retried = 0, slow = 0;
  long iterations = 0, steps = 0;

  void Add(const Run& run) {
    ++runs;
    converged += run.end == End::kConverged;
    named += run.end == End::kNamedFailure;
    unnamed += run.end == End::kUnnamedFailure;
    not_finite += run.end == End::kNotFinite;
    past_bound += run.end == End::kPastItsBound;
    retried += run.retried > 0;
    slow += run.slow();
    iterations += run.iterations;
    steps += run.steps;
  }
  int failures() const { return runs - converged; }
  void Print(const char* what) const {
    std::printf("%-22s %6d %9d %7d %7d %10d %7d %8d %6d %11.2f\n", what, runs, converged, named,
                unnamed, not_finite, past_bound, retried, slow,
                static_cast<double>(iterations) / static_cast<double>(std::max(1L, steps)));
  }
};

/// Whether all promises are kept.
bool Report(const std::vector<Run>& runs) {
  std::map<int, Counts> by_decade;
  Counts all, resolved;
  int listed = 0;
  for (const Run& run : runs) {
    if (run.end == End::kNotRun) continue;
    by_decade[static_cast<int>(std::floor(std::log10(run.EI)))].Add(run);
    all.Add(run);
    if (run.resolved) resolved.Add(run);
    if (run.end == End::kConverged || (++listed > kMostListed && !run.resolved)) continue;
    std::printf("cable %u%s %s\n", run.index, run.resolved ? "" : ", elements too long,",
                run.message.c_str());
  }
  if (listed > kMostListed) std::printf("... and others\n");
  std::printf("\n%-22s %6s %9s %7s %7s %10s %7s %8s %6s %11s\n", "EI [N m^2]", "cables",
              "converged", "failed", "unnamed", "not finite", "endless", "retried", "slow",
              "iterations");
  for (const auto& [decade, counts] : by_decade) {
    char what[40];
    std::snprintf(what, sizeof what, "from 1e%d", decade);
    counts.Print(what);
  }
  all.Print("all");
  resolved.Print("elements short enough");
  const double share = resolved.failures() / static_cast<double>(std::max(1, resolved.runs));
  std::printf("\nof those with elements short enough %.3g %% failed, at most %.3g %% may\n",
              100 * share, 100 * kMostFailures);
  return share <= kMostFailures && all.unnamed + all.not_finite + all.past_bound == 0;
}

int Main(int argc, char** argv) {
  std::uint32_t seed = 1, first = 0, count = 10000;
  int threads = 2;
  CLI::App app("Runs random cables through the simulation, and counts what becomes of them.");
  app.add_option("--seed", seed, "of all cables")->capture_default_str();
  app.add_option("--first", first, "number of the first one")->capture_default_str();
  app.add_option("--count", count, "how many")->capture_default_str();
  app.add_option("--threads", threads, "the results are the same")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  int code = 0;
  if (!Parse(&app, argc, argv, &code)) return code;
  CatchInterrupts();
  std::vector<Run> runs;
  {
    Progress progress(count, "cables");
    runs = RunCables(seed, first, count, threads, [&](std::uint32_t done) {
      progress.Update(done);
      return !Interrupted();
    });
  }
  const bool kept = Report(runs);
  if (Interrupted()) return kExitInterrupted;
  return kept ? kExitDone : kExitFailed;
}

}  // namespace
}  // namespace cosserat_cable::stress

int main(int argc, char** argv) {
  return cosserat_cable::RunTool([&] { return cosserat_cable::stress::Main(argc, argv); });
}
