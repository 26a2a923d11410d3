// Cables of different kinds in one vehicle: each moves, to the last bit, as it does in a vehicle of
// its own, whatever extensions, masses, ends and elements the others have.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "cable/cable_cases.h"
#include "cosserat_cable/cable/cable_fleet.h"

namespace cosserat_cable {
namespace {

using Eigen::Vector3d;

// The same cases in each run, unless somebody asks for others.
[[maybe_unused]] const int kFixedSeed = setenv("RC_PARAMS", "seed=20240611 max_success=12", 0);

constexpr int kSteps = 50;
constexpr double kDt = 1e-3;
const Vector3d kGravity(0, 0, -9.81);

class Random {
 public:
  explicit Random(unsigned seed) : rng_(seed) {}
  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(rng_);
  }
  double Decade(double low, double high) { return std::pow(10, Between(low, high)); }
  int Whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(rng_); }
  bool Chance(double of) { return Between(0, 1) < of; }

 private:
  std::mt19937 rng_;
};

/// A hose that hangs in a U over a floor, and how its end b is moved.
struct Case {
  CableModel model;
  double frequency, amplitude;
  int jump = -1;     // the step to a place so far away that it takes several
  int rest = -1;     // the step in which nobody moves it
  int nowhere = -1;  // the step to a place that is none
};

CableExtension Relaxation(double EI, Random* random) {
  CableExtension extension{"maxwell", {}};
  for (int k = random->Whole(1, 3); k > 0; --k)
    extension.parts.push_back({{"tau", random->Decade(-3, 0)},
                               {"EI1", EI * random->Between(0, 0.5)},
                               {"EI2", EI * random->Between(0, 0.5)},
                               {"GJ", random->Chance(0.5) ? 0.2 * EI : 0.0},
                               {"EA", 0.0}});
  return extension;
}

void AddSoftClamps(Random* random, CableModel* model) {
  CableExtension springs{"clamp_compliance", {{}}}, dashpots{"clamp_damping", {{}}};
  for (const char* path : {"a.bending", "a.torsion", "b.bending", "b.torsion"}) {
    if (random->Chance(0.5)) continue;
    springs.parts[0][path] = random->Decade(-0.5, 2);
    if (random->Chance(0.5)) dashpots.parts[0][path] = random->Decade(-5, -3);
  }
  if (springs.parts[0].empty()) springs.parts[0]["a.bending"] = 1;
  model->extensions.push_back(springs);
  if (!dashpots.parts[0].empty()) model->extensions.push_back(dashpots);
}

/// Friction or play in the clamps.
CableExtension LooseClamps(Random* random) {
  const bool friction = random->Chance(0.5);
  CableExtension extension{friction ? "clamp_friction" : "clamp_play", {{}}};
  for (const std::string clamp : {"a.", "b."}) {
    auto& numbers = extension.parts[0];
    if (clamp == "b." && random->Chance(0.5)) continue;
    if (friction) {
      numbers[clamp + "stuck"] = random->Decade(-1, 1);
      numbers[clamp + "slip_moment"] = random->Decade(-4, -2);
      numbers[clamp + "spring"] = random->Decade(-1, 1);
    } else {
      numbers[clamp + "gap"] = random->Decade(-3, -1);
      numbers[clamp + "stiffness"] = random->Decade(-1, 1);
    }
  }
  return extension;
}

void AddOutside(double length, Random* random, CableModel* model) {
  if (random->Chance(0.3))
    model->extensions.push_back({"air_drag", {{{"Cd", random->Decade(0, 2)}}}});
  if (random->Chance(0.3))
    model->extensions.push_back({"external_damping", {{{"rate", random->Decade(-1, 2)}}}});
  if (random->Chance(0.2))
    model->extensions.push_back(
        {"added_mass", {{{"s", random->Between(0, length)}, {"mass", 0.005}}}});
  if (random->Chance(0.3))
    model->extensions.push_back({"contact",
                                 {{{"peg.x", random->Between(-0.03, 0.03)},
                                   {"peg.y", -0.1},
                                   {"peg.z", random->Between(0.08, 0.12)},
                                   {"peg.azimuth", 0},
                                   {"peg.elevation", 0},
                                   {"peg.radius", 0.005}}}});
}

Case RandomCase(Random* random) {
  constexpr int kElements[] = {8, 12, 20};
  Case c;
  const double EI = random->Between(0.03, 0.06);
  c.model = RoundCableModel(random->Between(0.36, 0.5), 0.01, 0.12, EI, 0.8 * EI, 1e-4);
  c.model.elements = kElements[random->Whole(0, 2)];
  if (random->Chance(0.5)) c.model.EI2 *= random->Between(0.5, 2);
  for (int k = random->Chance(0.5) ? random->Whole(1, 2) : 0; k > 0; --k)
    c.model.masses.push_back({random->Between(0, c.model.length), random->Between(0.001, 0.02)});
  if (random->Chance(0.5)) c.model.extensions.push_back(Relaxation(EI, random));
  if (random->Chance(0.3)) AddSoftClamps(random, &c.model);
  if (random->Chance(0.3)) c.model.extensions.push_back(LooseClamps(random));
  AddOutside(c.model.length, random, &c.model);
  c.frequency = random->Between(50, 150);
  c.amplitude = random->Between(0.002, 0.01);
  if (random->Chance(0.2)) c.jump = random->Whole(1, kSteps);
  if (random->Chance(0.2)) c.rest = random->Whole(1, kSteps);
  if (random->Chance(0.2)) c.nowhere = random->Whole(1, kSteps);
  return c;
}

Surroundings At(const Case& c, int step) {
  const double w = c.frequency, t = step * kDt;
  Surroundings s;
  s.a.X.q = Eigen::Quaterniond(0, 1, 0, 0);
  s.b.X.p = {0, 0.2, c.amplitude * std::sin(w * t)};
  s.b.v.z() = c.amplitude * w * std::cos(w * t);
  s.b.a.z() = -c.amplitude * w * w * std::sin(w * t);
  s.obstacles.resize(1);
  if (step == c.jump) s.b.X.p.x() = 0.05;
  if (step == c.nowhere) s.a.X.p.y() = std::numeric_limits<double>::quiet_NaN();
  return s;
}

const Body& Floor() {
  static const Body floor({Shape{{{0, 0.1, -0.24}, {1, 0, 0, 0}}, Box{{1, 1, 0.1}}}});
  return floor;
}

/// All that a cable tells of itself, and what its step came to.
std::vector<double> AllOf(CableSimulation* cable, const StepOutcome& outcome) {
  std::vector<double> all = {outcome.ok ? 1.0 : 0.0, 1.0 * outcome.iterations,
                             1.0 * outcome.substeps};
  const auto add = [&](const Vector3d& v) { all.insert(all.end(), v.data(), v.data() + 3); };
  for (const Pose& node : cable->nodes()) {
    add(node.p);
    all.insert(all.end(), {node.q.w(), node.q.x(), node.q.y(), node.q.z()});
  }
  const CableReport report = cable->Report();
  for (const Vector3d& v : {report.apex, report.apex_velocity, report.force_a, report.moment_a,
                            report.force_b, report.moment_b})
    add(v);
  all.insert(all.end(), {report.curvature_max, report.contact_force, report.tension_max,
                         report.clearance, report.energy.work_ends, report.energy.work_loads,
                         report.energy.dissipated, report.energy.stored});
  return all;
}

/// What each cable tells, by step.
using Run = std::vector<std::vector<std::vector<double>>>;

Run Drive(const std::vector<Case>& cases, int threads) {
  std::vector<CableSimulation> cables;
  for (const Case& c : cases) {
    cables.emplace_back(c.model, std::vector<const Body*>{&Floor()}, kGravity);
    RC_ASSERT(cables.back().Settle(At(c, 0)).ok);
  }
  std::vector<CableSimulation*> pointers;
  for (CableSimulation& cable : cables) pointers.push_back(&cable);
  CableFleet fleet(pointers, threads);
  Run run;
  for (int step = 1; step <= kSteps; ++step) {
    std::vector<Surroundings> thens;
    for (const Case& c : cases) thens.push_back(At(c, step));
    std::vector<const Surroundings*> drives;
    for (std::size_t i = 0; i < cases.size(); ++i)
      drives.push_back(step == cases[i].rest ? nullptr : &thens[i]);
    const std::vector<StepOutcome> outcomes = fleet.Step(kDt, drives);
    run.emplace_back();
    for (std::size_t i = 0; i < cases.size(); ++i)
      run.back().push_back(AllOf(&cables[i], outcomes[i]));
  }
  return run;
}

RC_GTEST_PROP(MixedFleetTest, ACableDoesNotSeeOfWhatKindTheOthersAre, ()) {
  Random random(*rc::gen::arbitrary<unsigned>());
  std::vector<Case> cases;
  for (int n = random.Whole(2, 12); n > 0; --n) cases.push_back(RandomCase(&random));
  const Run together = Drive(cases, random.Whole(1, 3));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Run alone = Drive({cases[i]}, 1);
    for (int s = 0; s < kSteps; ++s) {
      // Not the lists themselves: their hundreds of numbers would be the message.
      const bool same = together[s][i] == alone[s][0];
      RC_ASSERT(same);
    }
  }
}

}  // namespace
}  // namespace cosserat_cable
