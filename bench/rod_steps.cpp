// What scripts/bench wants to know of the step beside its time: memory, and how often each
// instruction is executed.
#include <unistd.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <optional>
#include <string>

#include "instruction_trace.h"
#include "swept_cables.h"

namespace cosserat_cable::bench {
namespace {

constexpr const char* kUsage =
    "usage: rod_steps build                       compiler, flags, lanes\n"
    "       rod_steps memory CABLES ELEMENTS      bytes per cable, stepped in lanes\n"
    "       rod_steps one|lanes ELEMENTS STEPS    address and count of each instruction executed\n";

/// Memory of this process that is in use [bytes].
double Resident() {
  std::ifstream file("/proc/self/statm");
  double size = 0, resident = 0;
  if (!(file >> size >> resident)) throw std::runtime_error("no /proc/self/statm");
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void PrintMemory(int cables, int elements) {
  constexpr int kSteps = 10;
  const Drive drive;
  { Fleet(1, elements).Step(drive); }  // what is made once
  const double before = Resident();
  Fleet fleet(cables, elements);
  for (int k = 0; k < kSteps; ++k) fleet.Step(drive);
  std::printf("{\"bytes_per_cable\": %.0f}\n", (Resident() - before) / cables);
}

void PrintInstructions(bool lanes, int elements, int steps) {
  constexpr int kBefore = 50;  // the start from rest takes more iterations than what follows
  Drive drive;
  std::optional<rod::Rod> rod;
  std::optional<Fleet> fleet;
  const auto step = [&] {
    if (lanes)
      fleet->Step(drive);
    else if (!rod->Step(kDt, drive.a(), drive.b()).converged)
      throw std::runtime_error("a step did not converge");
    drive.Advance();
  };
  const auto prepare = [&] {
    if (lanes)
      fleet.emplace(rod::RodBatch::PreferredRods(), elements);
    else
      rod.emplace(Settled(CableP2(elements)));
    for (int k = 0; k < kBefore; ++k) step();
  };
  const auto work = [&] {
    for (int k = 0; k < steps; ++k) step();
  };
  for (const auto& [address, times] : TraceInstructions(prepare, work))
    std::printf("%" PRIx64 " %" PRIu64 "\n", address, times);
}

int Run(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "build" && argc == 2) {
    std::printf("{\"compiler\": \"%s\", \"flags\": \"%s\", \"lanes\": %d}\n",
                COSSERAT_CABLE_COMPILER, COSSERAT_CABLE_FLAGS, rod::RodBatch::PreferredRods());
  } else if (what == "memory" && argc == 4) {
    PrintMemory(std::atoi(argv[2]), std::atoi(argv[3]));
  } else if ((what == "one" || what == "lanes") && argc == 4) {
    PrintInstructions(what == "lanes", std::atoi(argv[2]), std::atoi(argv[3]));
  } else {
    std::fputs(kUsage, stderr);
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace cosserat_cable::bench

int main(int argc, char** argv) {
  try {
    return cosserat_cable::bench::Run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rod_steps: %s\n", error.what());
    return 3;
  }
}
