#include "sample_sets.h"

#include <algorithm>
#include <cmath>

#include "experiment_parts.h"

namespace cosserat_cable::generator {
namespace {

const double kPi = std::acos(-1.0);

}  // namespace

MeasurementSet randomSet(std::uint64_t seed, double snr, const EffectPlan& effects) {
  Random random(seed);
  MeasurementSet set = newSet("random", seed, snr);
  CableData cable = randomCable(&random);
  const int lengths = random.chance(0.5) ? 3 : 4;
  const double shortest = random.uniform(0.1, 0.15), longest = random.uniform(0.35, 0.5);
  const Disc disc = randomDisc(&cable, 0.5 * (shortest + longest), &random);
  set.D_E = disc.dashpot;
  set.truth = cable;
  std::vector<Experiment> experiments;
  // Up to horizontal; beyond, a soft cable hangs in other shapes than it was pulled from.
  experiments.push_back(ringdown("ringdown_small", cable, random.uniform(0.0, 0.5 * kPi),
                                 random.uniform(0.02, 0.08), ringdownTime(cable), &random));
  experiments.push_back(ringdown("ringdown_large", cable, random.uniform(0.0, 0.5 * kPi),
                                 random.uniform(0.1, 0.3), ringdownTime(cable), &random));
  if (random.chance(0.3)) addVelocity(&experiments.back());
  const bool guided = random.chance(0.5);
  for (int i = 0; i < lengths; ++i) {
    const double length = shortest + (longest - shortest) * i / (lengths - 1);
    experiments.push_back(torsion("torsion_" + std::to_string(i + 1), cable, length, disc, guided,
                                  torsionTime(cable, length, disc), &random));
  }
  set.uncertain = {"EI", "eta_EI", "GJ", "eta_GJ"};
  guess(&set, &random);
  applyEffects(effects, &experiments, &set);
  set.experiments = measure(experiments, snr, &random);
  return set;
}

MeasurementSet wireSet(std::uint64_t seed, double snr, const EffectPlan& effects) {
  Random random(seed);
  MeasurementSet set = newSet("wire", seed, snr);
  CableData c;
  c.length = 0.2;
  c.diameter = 3e-3;
  c.rhoA = 0.027;
  c.EI = 1.2e-3;
  c.GJ = 1.2e-3;
  c.eta_EI = 2.0 * 0.02 * c.EI / bendingFrequency(c);
  c.eta_GJ = c.eta_EI;
  set.truth = c;
  std::vector<Experiment> experiments;
  for (int i = 0; i < 2; ++i) {
    experiments.push_back(
        ringdown("ringdown_" + std::to_string(i + 1), c, 0.0, 0.03, 3.0, &random));
  }
  set.uncertain = {"EI", "eta_EI"};
  guess(&set, &random);
  applyEffects(effects, &experiments, &set);
  set.experiments = measure(experiments, snr, &random);
  return set;
}

MeasurementSet ringdownSet(std::uint64_t seed, double snr, const RingdownPlan& plan,
                           const EffectPlan& effects) {
  constexpr double kPeriods = 8.0, kSamplesPerPeriod = 30.0;
  Random random(seed);
  MeasurementSet set = newSet("ringdowns", seed, snr);
  const CableData cable = randomCable(&random);
  set.truth = cable;
  const double period = 2.0 * kPi / bendingFrequency(cable);
  const double duration = std::clamp(kPeriods * period, 1.0, 2.0);
  std::vector<Experiment> experiments;
  const int records = random.chance(0.5) ? 1 : 2;
  for (int i = 0; i < records; ++i) {
    experiments.push_back(ringdown("ringdown_" + std::to_string(i + 1), cable,
                                   random.uniform(0.0, 0.5 * kPi), random.uniform(0.02, 0.15),
                                   duration, &random));
    experiments.back().times =
        jitteredTimes(duration, kSamplesPerPeriod / period, kJitter, &random);
  }
  set.uncertain = {"EI", "eta_EI"};
  guess(&set, &random);
  applyEffects(effects, &experiments, &set);
  set.experiments = measure(experiments, snr, &random);
  if (plan.unknown_start) {
    for (MeasuredExperiment& one : set.experiments) {
      forgetStart(random.uniform(0.2, 1.0) * period, &one);
    }
  }
  return set;
}

MeasurementSet torsionSeries(std::uint64_t seed, double snr, const TorsionPlan& plan,
                             const EffectPlan& effects) {
  const int lengths = plan.lengths;
  constexpr double kRatio = 0.25;  // damping ratio at the shortest length
  constexpr double kPeriods = 5.0, kSamplesPerPeriod = 40.0;
  Random random(seed);
  MeasurementSet set = newSet(lengths > 1 ? "torsion-series" : "torsion-single", seed, snr);
  CableData c;
  c.length = 0.25;
  c.diameter = 8e-3;
  c.rhoA = 0.09;
  c.GJ = random.logUniform(1e-3, 1e-2);
  c.EI = c.GJ / random.uniform(0.6, 1.6);
  c.eta_EI = 2e-4;
  c.eta_GJ = 2e-4 * random.uniform(0.8, 1.25);
  const double shortest = lengths > 1 ? 0.1 : c.length, longest = plan.longest;
  Disc disc;
  disc.dashpot = random.uniform(1.0, 3.0) * c.eta_GJ / (lengths > 1 ? 0.25 : c.length);
  const double delta = (c.eta_GJ / shortest + disc.dashpot) / 2.0;  // times the inertia
  disc.inertia = std::pow(delta / kRatio, 2) * shortest / c.GJ;
  disc.mass = discMass(disc.inertia, c, &random);
  set.truth = c;
  set.D_E = disc.dashpot;
  std::vector<Experiment> experiments;
  for (int i = 0; i < lengths; ++i) {
    const double length =
        lengths > 1 ? shortest + (longest - shortest) * i / (lengths - 1) : shortest;
    for (int repeat = 0; repeat < plan.repeats; ++repeat) {
      const std::string name =
          "torsion_" + std::to_string(i + 1) + "_" + std::to_string(repeat + 1);
      // As slow as the discs of a pendulum whose fixation damps so much: a camera is enough.
      const double period = 2.0 * kPi * std::sqrt(disc.inertia * length / c.GJ);
      Disc fastened = disc;
      fastened.dashpot *= std::max(0.0, 1.0 + plan.scatter * random.normal());
      experiments.push_back(torsion(name, c, length, fastened, true, kPeriods * period, &random));
      experiments.back().times =
          jitteredTimes(kPeriods * period, kSamplesPerPeriod / period, kJitter, &random);
    }
  }
  set.uncertain = {"GJ", "eta_GJ"};
  guess(&set, &random);
  applyEffects(effects, &experiments, &set);
  set.experiments = measure(experiments, snr, &random);
  return set;
}

MeasurementSet sixRecords(std::uint64_t seed, double snr, const EffectPlan& effects) {
  constexpr double kDuration = 3.0;
  Random random(seed);
  MeasurementSet set = newSet("six", seed, snr);
  CableData cable = randomCable(&random);
  const Disc disc = randomDisc(&cable, 0.25, &random);
  set.truth = cable;
  set.D_E = disc.dashpot;
  std::vector<Experiment> experiments;
  for (int i = 0; i < 3; ++i) {
    experiments.push_back(ringdown("ringdown_" + std::to_string(i + 1), cable,
                                   random.uniform(0.0, 0.5 * kPi), 0.05 + 0.1 * i, kDuration,
                                   &random));
  }
  for (int i = 0; i < 3; ++i) {
    experiments.push_back(torsion("torsion_" + std::to_string(i + 1), cable, 0.1 + 0.15 * i, disc,
                                  true, kDuration, &random));
  }
  set.uncertain = {"EI", "eta_EI", "GJ", "eta_GJ"};
  guess(&set, &random);
  applyEffects(effects, &experiments, &set);
  set.experiments = measure(experiments, snr, &random);
  return set;
}

}  // namespace cosserat_cable::generator
