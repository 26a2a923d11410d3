// This package's rod beside MuJoCo on one and the same case (swept_arch.h): how accurate either is,
// and what the same accuracy costs. One JSON object on standard output, what goes on on the other.
//   --quick   the first 1.5 s, and a few settings: shows that all of it works
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <sstream>

#include "peer_search.h"
#include "rod_arch.h"

namespace cosserat_cable::bench {
namespace {

constexpr double kTolerance = 0.02;  // of the apex' amplitude
constexpr int kRaces = 5;
constexpr int kReferenceElements = 160;
constexpr double kReferenceStep = 2.5e-4;  // s

/// What is tried, and how much of the sweep.
struct Plan {
  Grid rod;
  MujocoGrid full_damping, light_damping;
};

Plan Full() {
  constexpr double kEnd = SweptArch::kDuration, kBudget = 60;  // s
  // Which solver finds the forces of the welds makes no difference to the result.
  return {{{6, 8, 10, 12, 16, 20, 40}, {4e-3, 2e-3, 1e-3, 5e-4}, kEnd},
          {{{10, 20}, {1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5}, kEnd},
           {"Euler", "implicit", "RK4"},
           {"Newton"},
           kBudget},
          {{{10, 12, 14, 16, 20, 24, 32, 40}, {8e-4, 4e-4, 3e-4, 2e-4, 1e-4, 5e-5}, kEnd},
           {"Euler", "implicit", "RK4"},
           {"Newton", "PGS", "CG"},
           kBudget}};
}

Plan Quick() {
  constexpr double kEnd = 1.5, kBudget = 10;  // s
  return {{{8, 16}, {2e-3, 1e-3}, kEnd},
          {{{10}, {5e-4, 5e-5}, kEnd}, {"Euler"}, {"Newton"}, kBudget},
          {{{10, 12}, {4e-4, 2e-4}, kEnd}, {"Euler"}, {"Newton"}, kBudget}};
}

void Progress(const Trial& trial) {
  std::fprintf(stderr, "%s: %d elements, %g ms%s%s: %s", trial.code.c_str(), trial.elements,
               1e3 * trial.dt, trial.integrator.empty() ? "" : (", " + trial.integrator).c_str(),
               trial.solver.empty() ? "" : (", " + trial.solver).c_str(),
               trial.run.outcome.c_str());
  if (trial.run.done())
    std::fprintf(stderr, ", %.3f s, apex within %.2g %%, sway %.2g %%", trial.run.seconds,
                 100 * trial.apex_error, 100 * trial.sway_error);
  std::fputc('\n', stderr);
}

std::string Json(const std::vector<double>& numbers) {
  std::ostringstream out;
  for (std::size_t i = 0; i < numbers.size(); ++i) out << (i ? ", " : "") << numbers[i];
  return "[" + out.str() + "]";
}

std::string Json(const Trial& trial) {
  std::ostringstream out;
  out << "{\"code\": \"" << trial.code << "\", \"elements\": " << trial.elements
      << ", \"dt\": " << trial.dt;
  if (!trial.integrator.empty())
    out << ", \"integrator\": \"" << trial.integrator << "\", \"solver\": \"" << trial.solver
        << "\"";
  out << ", \"outcome\": \"" << trial.run.outcome << "\"";
  if (trial.run.done())
    out << ", \"apex_error\": " << trial.apex_error << ", \"sway_error\": " << trial.sway_error
        << ", \"seconds\": " << trial.run.seconds;
  return out.str() + "}";
}

std::string Json(const std::vector<Trial>& trials) {
  std::string out;
  for (const Trial& trial : trials) out += (out.empty() ? "" : ",\n      ") + Json(trial);
  return "[\n      " + out + "]";
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// Both in turn, so that a machine that is slow for a while is slow for both.
std::string Race(const SweptArch& arch, const Trial& rod, const Trial& mujoco, double end) {
  // A run of the rod is short: as many as fill this.
  constexpr double kLongEnough = 0.2;  // s
  const int laps = std::max(1, static_cast<int>(std::ceil(kLongEnough / rod.run.seconds)));
  std::vector<double> rods, mujocos, ratios;
  for (int race = 0; race < kRaces; ++race) {
    double seconds = 0;
    for (int lap = 0; lap < laps; ++lap) seconds += Repeat(arch, rod, end).seconds;
    rods.push_back(seconds / laps);
    mujocos.push_back(Repeat(arch, mujoco, end).seconds);
    ratios.push_back(mujocos.back() / rods.back());
    std::fprintf(stderr, "race %d of %d: %.4f s and %.3f s\n", race + 1, kRaces, rods.back(),
                 mujocos.back());
  }
  return "{\"rod_seconds\": " + Json(rods) + ", \"mujoco_seconds\": " + Json(mujocos) +
         ", \"ratios\": " + Json(ratios) + ", \"ratio\": " + std::to_string(Median(ratios)) + "}";
}

Target Reference(const SweptArch& arch, double end) {
  const SweepRun run =
      RunSweep(RodArch(arch, {kReferenceElements, kReferenceStep}), kReferenceStep, end);
  if (!run.done()) throw std::runtime_error("the reference is " + run.outcome);
  return {run.apex, run.sway};
}

std::string Header(const SweptArch& arch, const Target& target) {
  std::ostringstream out;
  out << "{\"eta_EI\": " << arch.eta_EI << ",\n     \"apex\": " << Json(target.apex)
      << ", \"sway\": " << Json(target.sway) << ",\n     ";
  return out.str();
}

std::string FullDamping(const Plan& plan) {
  const SweptArch arch;
  const Target target = Reference(arch, plan.rod.end);
  const std::vector<Trial> rod = TryRod(arch, target, plan.rod, Progress);
  const std::vector<Trial> mujoco = TryMujoco(arch, target, plan.full_damping, 0, Progress);
  return Header(arch, target) + "\"rod\": " + Json(rod) + ",\n     \"mujoco\": " + Json(mujoco) +
         "}";
}

std::string LightDamping(const Plan& plan) {
  SweptArch arch;
  arch.eta_EI *= 0.01;
  const Target target = Reference(arch, plan.rod.end);
  const std::vector<Trial> rod = TryRod(arch, target, plan.rod, Progress);
  const std::vector<Trial> mujoco =
      TryMujoco(arch, target, plan.light_damping, kTolerance, Progress);
  const Trial* ours = Cheapest(rod, kTolerance);
  if (!ours) throw std::runtime_error("no setting of the rod is within the tolerance");
  const Trial* theirs = Cheapest(mujoco, kTolerance);
  const bool reached = theirs != nullptr;
  if (!reached) theirs = MostAccurate(mujoco);
  std::string out = Header(arch, target) + "\"rod\": " + Json(rod) +
                    ",\n     \"mujoco\": " + Json(mujoco) +
                    ",\n     \"mujoco_within_tolerance\": " + (reached ? "true" : "false");
  if (theirs)
    out += ",\n     \"chosen\": [" + Json(*ours) + ", " + Json(*theirs) +
           "],\n     \"race\": " + Race(arch, *ours, *theirs, plan.rod.end);
  return out + "}";
}

std::string Compare(bool quick) {
  const Plan plan = quick ? Quick() : Full();
  std::ostringstream out;
  out << "{\"mujoco_version\": \"" << mj_versionString() << "\", \"tolerance\": " << kTolerance
      << ", \"sweep_seconds\": " << plan.rod.end
      << ",\n \"reference\": {\"elements\": " << kReferenceElements
      << ", \"dt\": " << kReferenceStep << "},\n";
  out << " \"full_damping\": " << FullDamping(plan) << ",\n";
  out << " \"light_damping\": " << LightDamping(plan) << "}\n";
  return out.str();
}

/// MuJoCo tells of each unstable state, and writes a file of it: the table says so already.
void Quiet(const char*) {}

}  // namespace
}  // namespace cosserat_cable::bench

int main(int argc, char** argv) {
  const bool quick = argc == 2 && !std::strcmp(argv[1], "--quick");
  if (argc > 1 && !quick) {
    std::fprintf(stderr, "usage: mujoco_bench [--quick]\n");
    return 2;
  }
  mju_user_warning = cosserat_cable::bench::Quiet;
  try {
    std::fputs(cosserat_cable::bench::Compare(quick).c_str(), stdout);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mujoco_bench: %s\n", error.what());
    return 3;
  }
}
